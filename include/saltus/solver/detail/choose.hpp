// From the name of a method to a solver.
#pragma once

#include <memory>
#include <string_view>

#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/method.hpp"

namespace saltus {

/// Refuses a linear solver that there is not, or that the method would not use; ModelError.
void require_linear_solver(std::string_view linear_solver, std::string_view method);

/// The solver of a method for one run. CVODE is made only where it is asked for, or once "auto"
/// needs it.
std::unique_ptr<Solver> make_solver(Method method, Machine& machine, GuardSet& guards,
                                    const SolverOptions& options);

}  // namespace saltus
