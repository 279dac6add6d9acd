// From the name of a method to a solver.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

enum class Method { automatic, dopri5, dop853, adams, bdf };

inline constexpr std::array<std::pair<std::string_view, Method>, 11> method_names{{
    {"auto", Method::automatic},
    {"dopri5", Method::dopri5},
    {"dop853", Method::dop853},
    {"adams", Method::adams},
    {"bdf", Method::bdf},
    {"rk45", Method::dopri5},  // synonyms
    {"RK45", Method::dopri5},
    {"DOP853", Method::dop853},
    {"non-stiff", Method::dopri5},
    {"stiff", Method::bdf},
    {"BDF", Method::bdf},
}};

/// The method of that name; a ModelError with the nearest name if there is none.
inline Method method_from(std::string_view name) {
  return detail::value_of(method_names, "ode_solver_method", name);
}

/// Refuses a linear solver that there is not, or that the method would not use; ModelError.
void require_linear_solver(std::string_view linear_solver, std::string_view method);

/// The solver of a method for one run. CVODE is made only where it is asked for, or once "auto"
/// needs it.
std::unique_ptr<Solver> make_solver(Method method, Machine& machine, GuardSet& guards,
                                    const SolverOptions& options);

}  // namespace saltus
