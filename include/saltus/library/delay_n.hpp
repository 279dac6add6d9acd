// y[k] = u[k-n], and initial_state for k < n; held from tick k, at t = k dt, to the next tick.
// in, out: the shape of initial_state. Ticks are exact time events.
#pragma once

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct DelayNOptions {
  Value initial_state = 0.0;
};

class DelayN final : public detail::SampledSystem {
 public:
  using Options = DelayNOptions;

  /// n >= 1 ticks.
  DelayN(std::string name, double dt, int n, const Options& options = {});
};

}  // namespace saltus
