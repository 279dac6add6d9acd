// Taylor series as a Solver.
#pragma once

#include <memory>
#include <string>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

/// The Taylor method: each step is a power series of the solution, whose coefficients follow from
/// those of the expressions of f by recurrences (A. Jorba, M. Zou, "A software package for the
/// numerical integration of ODEs by means of high-order Taylor methods", Experimental Mathematics 14
/// (2005) 99). The series is the dense output, and those of the guards say where to look for their
/// crossings. The derivatives of the plan must have series: see `taylor_obstacle`.
std::unique_ptr<Solver> make_taylor(Machine& machine, GuardSet& guards,
                                    const SolverOptions& options);

/// Why the derivatives of a plan have no Taylor series; empty if they have.
std::string taylor_obstacle(const Plan& plan);

}  // namespace saltus
