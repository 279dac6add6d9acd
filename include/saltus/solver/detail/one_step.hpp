// The explicit one-step methods: the functions that "auto" needs, and the functions that make them.
#pragma once

#include <memory>

#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/stiffness.hpp"

namespace saltus {

class OneStepSolver : public Solver {
 public:
  /// Tests for stiffness from now on.
  virtual void watch_stiffness() = 0;
  /// The record of the last steps.
  virtual StiffnessTest& stiffness() = 0;
  /// h |lambda| beyond which stability bounds the step.
  virtual double stability() const = 0;
};

/// Each method is compiled once for each of one to four states, for which the whole arithmetic of a
/// step unrolls, and once for any number. Each method has its own file, because the compiler
/// inlines less if both are in one.
std::unique_ptr<OneStepSolver> make_dopri5(Machine& machine, GuardSet& guards,
                                           const SolverOptions& options);
std::unique_ptr<OneStepSolver> make_dop853(Machine& machine, GuardSet& guards,
                                           const SolverOptions& options);

}  // namespace saltus
