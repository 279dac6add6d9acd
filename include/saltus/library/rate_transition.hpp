// y[k] = u[k]: the input at tick k, at t = offset + k dt, held to the next tick.
// in, out: the shape of initial_state, which is y before the first tick. At a tick y is the value
// that u has at this tick, after all outputs before it. A ZeroOrderHold, in contrast, shows a block
// that samples it at the same tick the value before the tick. So a block with a slow period reads a
// block with a fast period without a delay.
#pragma once

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct RateTransitionOptions {
  Value initial_state = 0.0;
  double offset = 0.0;  ///< [s] the time of the first tick
};

class RateTransition final : public detail::SampledSystem {
 public:
  using Options = RateTransitionOptions;

  RateTransition(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
