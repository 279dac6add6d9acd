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
    amplitude_ = declare_dynamic_parameter("amplitude", options.amplitude.values);
    frequency_ = declare_dynamic_parameter("frequency", options.frequency.values);
    phase_ = declare_dynamic_parameter("phase", options.phase.values);
    bias_ = declare_dynamic_parameter("bias", options.bias.values);
    const std::vector<Shape> values{options.amplitude.shape(), options.frequency.shape(),
                                    options.phase.shape(), options.bias.shape()};
    declare_output_port({.name = "out",
                         .calc = &Sine::value,
                         .shape = detail::stretched(this->name(), values),
                         .reads = Reads::time});
  }

 private:
  void value(const At& at, VectorRef out) const {
    const auto entry = [&](ParameterIndex k, Index i) {
      return at.p[k.offset + (k.size == 1 ? 0 : i)];
    };
    for (Index i = 0; i < out.size(); ++i) {
      out[i] = entry(amplitude_, i) * std::sin(entry(frequency_, i) * at.time + entry(phase_, i)) +
               entry(bias_, i);
    }
  }

  ParameterIndex amplitude_, frequency_, phase_, bias_;
};

}  // namespace saltus
