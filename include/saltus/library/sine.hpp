// y = amplitude sin(frequency t + phase) + bias, elementwise.
// out: elementwise of the options. Parameters "amplitude", "frequency" [rad/s], "phase" [rad],
// "bias". Continuous.
#pragma once

#include <cmath>

#include "saltus/library/elementwise.hpp"

namespace saltus {

struct SineOptions {
  Value amplitude = 1.0;
  Value frequency = 1.0;  ///< [rad/s]
  Value phase = 0.0;      ///< [rad]
  Value bias = 0.0;
};

class Sine final : public LeafSystem {
 public:
  using Options = SineOptions;

  explicit Sine(std::string name, const Options& options = {}) : LeafSystem(std::move(name)) {
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
};

}  // namespace saltus
