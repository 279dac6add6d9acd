// y = start_value + slope max(0, t - start_time), elementwise.
// out: elementwise of start_value and slope. Parameters "start_value", "slope" [1/s]. Continuous.
// The kink at start_time is an exact time event, so no solver step spans it. The two branches agree
// there: a stage at the very end of the step before, or an ulp past it, sees the value of both.
#pragma once

#include <algorithm>

#include "saltus/library/elementwise.hpp"

namespace saltus {

struct RampOptions {
  Value start_value = 0.0;
  Value slope = 1.0;        ///< [1/s]
  double start_time = 1.0;  ///< [s] structure, not a parameter: time events are known before a run
};

class Ramp final : public LeafSystem {
 public:
  using Options = RampOptions;

  explicit Ramp(std::string name, const Options& options = {})
      : LeafSystem(std::move(name)), start_time_(options.start_time) {
    start_ = declare_dynamic_parameter("start_value", options.start_value.values);
    slope_ = declare_dynamic_parameter("slope", options.slope.values);
    const std::vector<Shape> values{options.start_value.shape(), options.slope.shape()};
    declare_output_port({.name = "out",
                         .calc = &Ramp::value,
                         .shape = detail::stretched(this->name(), values),
                         .reads = Reads::time});
    declare_one_shot(start_time_, {}, "start");
  }

 private:
  void value(const At& at, VectorRef out) const {
    const double run = std::max(0.0, at.time - start_time_);
    const VectorView start = at.parameter(start_), slope = at.parameter(slope_);
    for (Index i = 0; i < out.size(); ++i)
      out[i] = detail::entry(start, i) + detail::entry(slope, i) * run;
  }

  double start_time_;  // [s]
  ParameterIndex start_, slope_;
};

}  // namespace saltus
