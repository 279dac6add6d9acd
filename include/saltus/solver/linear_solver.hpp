// The linear solvers for the Newton iteration of a stiff method.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "saltus/base/list.hpp"
#include "saltus/model/event.hpp"

namespace saltus {

/// How the linear systems are solved. `automatic` chooses by the number of states and the entries
/// of the Jacobian.
enum class LinearSolver { automatic, dense, band, sparse, gmres };

/// The names, in the order of the enum.
inline constexpr std::array<std::pair<std::string_view, LinearSolver>, 5> linear_solver_names{{
    {"auto", LinearSolver::automatic},
    {"dense", LinearSolver::dense},
    {"band", LinearSolver::band},
    {"sparse", LinearSolver::sparse},
    {"gmres", LinearSolver::gmres},
}};

/// The linear solver of that name. Throws a ModelError with the nearest name if there is none.
inline LinearSolver linear_solver_from(std::string_view name) {
  return detail::value_of(linear_solver_names, "linear_solver", name);
}

constexpr std::string_view to_string(LinearSolver solver) {
  return nth(linear_solver_names, solver).first;
}

}  // namespace saltus
