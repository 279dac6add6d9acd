// Taylor series as a Solver.
#pragma once

#include <memory>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

/// The Taylor method: each step is a power series of the solution, whose coefficients follow from
/// those of the expressions of f by recurrences (A. Jorba, M. Zou, "A software package for the
/// numerical integration of ODEs by means of high-order Taylor methods", Experimental Mathematics
/// 14 (2005) 99). The series is the dense output, and those of the guards say where to look for
/// their crossings. Throws as `require_taylor_series`.
std::unique_ptr<Solver> make_taylor(Machine& machine, GuardSet& guards,
                                    const SolverOptions& options);

/// Throws a ModelError, with the first reason, if a derivative of the plan has no Taylor series.
void require_taylor_series(const Plan& plan);

}  // namespace saltus
