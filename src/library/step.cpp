// y = start_value for t < step_time, end_value from step_time on.
#include "saltus/library/step.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/schedule.hpp"

namespace saltus {

Step::Step(std::string name, const Options& options)
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

void Step::value(const At& at, VectorRef out) const {
  const VectorView now = at.parameter(detail::since(at.time, step_time_) >= 0.0 ? end_ : start_);
  for (Index i = 0; i < out.size(); ++i) out[i] = detail::entry(now, i);
}

}  // namespace saltus
