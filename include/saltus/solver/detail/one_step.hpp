// The explicit one-step methods: what "auto" asks of one, and where they are made.
#pragma once

#include <memory>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

class OneStepSolver : public Solver {
 public:
  /// Looks for stiffness from now on.
  virtual void watch_stiffness() = 0;
  /// Whether the last steps were bounded by stability rather than by accuracy.
  virtual bool looks_stiff() const = 0;
  /// h |lambda| beyond which stability bounds the step.
  virtual double stability() const = 0;
};

/// Each is compiled once for one to four states, where the whole arithmetic of a step unrolls, and
/// once for any number; each in a file of its own: together in one, the compiler inlines less.
std::unique_ptr<OneStepSolver> make_dopri5(Machine& machine, GuardSet& guards,
                                           const SolverOptions& options);
std::unique_ptr<OneStepSolver> make_dop853(Machine& machine, GuardSet& guards,
                                           const SolverOptions& options);

}  // namespace saltus
