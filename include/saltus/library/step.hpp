// y = start_value for t < step_time, end_value from step_time on.
// out: elementwise of both values. Parameters "start_value", "end_value". Held; changes at an exact
// time event.
#pragma once

#include "saltus/library/elementwise.hpp"
#include "saltus/library/schedule.hpp"

namespace saltus {

struct StepOptions {
  Value start_value = 0.0;
  Value end_value = 1.0;
  double step_time = 1.0;  ///< [s] structure, not a parameter: time events are known before a run
};

class Step final : public LeafSystem {
 public:
  using Options = StepOptions;

  explicit Step(std::string name, const Options& options = {})
      : LeafSystem(std::move(name)), step_time_(options.step_time) {
    start_ = declare_dynamic_parameter("start_value", options.start_value.values);
    end_ = declare_dynamic_parameter("end_value", options.end_value.values);
    const std::vector<Shape> values{options.start_value.shape(), options.end_value.shape()};
    declare_output_port({.name = "out",
                         .calc = &Step::value,
                         .shape = detail::stretched(this->name(), values),
                         .reads = Reads::schedule});
    declare_one_shot(step_time_, {}, "step");
  }

 private:
  void value(const At& at, VectorRef out) const {
    const VectorView now = at.parameter(detail::since(at.time, step_time_) >= 0.0 ? end_ : start_);
    for (Index i = 0; i < out.size(); ++i) out[i] = detail::entry(now, i);
  }

  double step_time_;  // [s]
  ParameterIndex start_, end_;
};

}  // namespace saltus
