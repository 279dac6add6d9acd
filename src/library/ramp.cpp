// y = start_value + slope max(0, t - start_time), elementwise.
#include "saltus/library/ramp.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Ramp::Ramp(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const ParameterIndex start = declare_dynamic_parameter("start_value", options.start_value.values);
  const ParameterIndex slope = declare_dynamic_parameter("slope", options.slope.values);
  const std::vector<Shape> values{options.start_value.shape(), options.slope.shape()};
  declare_output_port({.name = "out",
                       .shape = detail::stretched(this->name(), values),
                       .reads = Reads::time,
                       .formula = [=, begin = options.start_time](const auto& at) {
                         const auto run = at.time() - begin;
                         return at.p(start) + at.p(slope) * at.choose(run > 0.0, run, 0.0);
                       }});
  declare_one_shot(options.start_time, {}, "start");
}

}  // namespace saltus
