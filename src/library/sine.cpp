// y = amplitude sin(frequency t + phase) + bias, elementwise.
#include "saltus/library/sine.hpp"

#include <cmath>

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Sine::Sine(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const auto parameter = [this](const char* what, const Value& value) {
    return declare_dynamic_parameter(what, value.values);
  };
  const ParameterIndex amplitude = parameter("amplitude", options.amplitude);
  const ParameterIndex frequency = parameter("frequency", options.frequency);
  const ParameterIndex phase = parameter("phase", options.phase);
  const ParameterIndex bias = parameter("bias", options.bias);
  const std::vector<Shape> values{options.amplitude.shape(), options.frequency.shape(),
                                  options.phase.shape(), options.bias.shape()};
  declare_output_port({.name = "out",
                       .shape = detail::stretched(this->name(), values),
                       .reads = Reads::time,
                       .formula = [=](const auto& at) {
                         using std::sin;
                         return at.p(amplitude) * sin(at.p(frequency) * at.time() + at.p(phase)) +
                                at.p(bias);
                       }});
}

}  // namespace saltus
