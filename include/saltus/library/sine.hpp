// y = amplitude sin(frequency t + phase) + bias, elementwise.
// out: elementwise of the options. Parameters "amplitude", "frequency" [rad/s], "phase" [rad],
// "bias". Continuous.
#pragma once

#include "saltus/library/detail/arguments.hpp"

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

  explicit Sine(std::string name, const Options& options = {});
};

}  // namespace saltus
