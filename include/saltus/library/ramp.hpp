// y = start_value + slope max(0, t - start_time), elementwise.
// out: elementwise of start_value and slope. Parameters "start_value", "slope" [1/s]. Continuous.
// The kink at start_time is an exact time event, so no solver step spans it. The two branches agree
// there: a stage at the very end of the step before, or an ulp past it, gets the value of both.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct RampOptions {
  Value start_value = 0.0;
  Value slope = 1.0;        ///< [1/s]
  double start_time = 1.0;  ///< [s] structure, not a parameter: time events are known before a run
};

class Ramp final : public LeafSystem {
 public:
  using Options = RampOptions;

  explicit Ramp(std::string name, const Options& options = {});
};

}  // namespace saltus
