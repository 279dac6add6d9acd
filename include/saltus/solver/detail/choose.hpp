// The choice of the solver for a method.
#pragma once

#include <memory>

#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/method.hpp"

namespace saltus {

/// Throws ModelError for a linear solver that the method would not use.
void require_linear_solver(LinearSolver linear_solver, Method method);

/// Throws ModelError if the method is `taylor` and a derivative of the plan has no Taylor series.
void require_series(const Plan& plan, Method method);

/// Makes the solver of a method for one run. CVODE is made only if the user asks for it, or when
/// "auto" first needs it.
std::unique_ptr<Solver> make_solver(Method method, Machine& machine, GuardSet& guards,
                                    const SolverOptions& options);

}  // namespace saltus
