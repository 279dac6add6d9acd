// y[k] = u[k]: the input at tick k, at t = k dt, held to the next tick.
// in, out: the shape of initial_state, which is y before the first tick. At a tick y is u as it is
// at that tick, with all outputs before it: a ZeroOrderHold shows a block that samples it at the
// same tick the value before. So blocks with a slow period read those with a fast one without a
// delay.
#pragma once

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct RateTransitionOptions {
  Value initial_state = 0.0;
};

class RateTransition final : public detail::SampledSystem {
 public:
  using Options = RateTransitionOptions;

  RateTransition(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
