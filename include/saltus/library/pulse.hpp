// y = amplitude for phase_delay + k period <= t < phase_delay + (k + pulse_width) period, k = 0, 1,
// ...; otherwise 0. out: shape of amplitude. Parameter "amplitude". Held; both edges are exact time
// events.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct PulseOptions {
  Value amplitude = 1.0;
  double period = 1.0;  ///< [s] > 0
  /// The fraction of the period in which the pulse is high, 0 <= pulse_width <= 1.
  double pulse_width = 0.5;
  double phase_delay = 0.0;  ///< [s] the first rise; y is 0 before it
};

class Pulse final : public LeafSystem {
 public:
  using Options = PulseOptions;

  explicit Pulse(std::string name, const Options& options = {});

 private:
  void value(const At& at, VectorRef out) const;

  double period_, width_, delay_;  // [s]
  ParameterIndex amplitude_;
};

}  // namespace saltus
