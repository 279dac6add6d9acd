// Radau IIA as a Solver.
#pragma once

#include <memory>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

/// The matrices of Radau cannot be factorised, or no longer: places of the Jacobian were missed,
/// and with them the factors would fill up.
class NoFactors : public SimulationError {
 public:
  using SimulationError::SimulationError;
};

/// Implicit Runge-Kutta methods of 3, 5 and 7 stages, orders 5, 9 and 13, for stiff scenes: A- and
/// L-stable, without a history (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II,
/// 2nd ed., IV.8; "Stiff differential equations solved by Radau methods", J. Comput. Appl. Math.
/// 111 (1999) 93).
std::unique_ptr<Solver> make_radau(Machine& machine, GuardSet& guards,
                                   const SolverOptions& options);

}  // namespace saltus
