// The interface by which the stepper calls steps compiled together with a right-hand side.
#pragma once

#include <cstdint>
#include <type_traits>

#include "saltus/model/right_hand_side.hpp"
#include "saltus/solver/detail/dopri5.hpp"

namespace saltus::detail {

struct Attempt;

/// A right-hand side, its leaf, its arguments, and the count of its calls.
struct Caller {
  const VectorFunction* function;
  const LeafSystem* leaf;
  const At* at;
  std::int64_t* calls;
};

/// The memory of a stepper for one step: see ExplicitStep.
struct StepMemory {
  const double* x0;
  double *x1, *scratch, *k;
};

/// The steps of one method: ExplicitStep::attempt, and its stages for the dense output alone.
struct MethodKernels {
  double (*attempt)(const Caller&, const Attempt&, const StepMemory&);
  void (*dense)(const Caller&, double t0, double h, const StepMemory&);
};

/// The steps of both methods. Only `inlined` makes InlinedSteps, so each InlinedSteps is a
/// StepKernels.
struct StepKernels : InlinedSteps {
  MethodKernels dopri5, dop853;

  template <class Method>
  const MethodKernels& of() const {
    if constexpr (std::is_same_v<Method, Dopri5>)
      return dopri5;
    else
      return dop853;
  }
};

inline const StepKernels& kernels_of(const RightHandSide& right_hand_side) {
  return static_cast<const StepKernels&>(*right_hand_side.steps);
}

}  // namespace saltus::detail
