// y = amplitude for phase_delay + k period <= t < phase_delay + (k + pulse_width) period, k = 0, 1,
// ...; else 0. out: shape of amplitude. Parameter "amplitude". Held; both edges are exact time
// events.
#pragma once

#include "saltus/library/arguments.hpp"
#include "saltus/library/schedule.hpp"

namespace saltus {

struct PulseOptions {
  Value amplitude = 1.0;
  double period = 1.0;  ///< [s] > 0
  double pulse_width =
      0.5;  ///< the fraction of the period in which the pulse is high, 0 <= pulse_width <= 1
  double phase_delay = 0.0;  ///< [s] the first rise; 0 before it
};

class Pulse final : public LeafSystem {
 public:
  using Options = PulseOptions;

  explicit Pulse(std::string name, const Options& options = {})
      : LeafSystem(std::move(name)),
        period_(options.period),
        width_(options.pulse_width * options.period),
        delay_(options.phase_delay) {
    const double fraction = options.pulse_width;
    detail::require_period(this->name(), "period", period_);
    detail::insist(fraction >= 0.0 && fraction <= 1.0, this->name(), "pulse_width = ", fraction,
                   "; expected the fraction of the period in which the pulse is high, 0 to 1");
    amplitude_ = declare_dynamic_parameter("amplitude", options.amplitude.values);
    declare_output_port({.name = "out",
                         .calc = &Pulse::value,
                         .shape = options.amplitude.shape(),
                         .reads = Reads::schedule});
    declare_periodic_update({}, period_, delay_, "rise");
    // Always low or always high: no fall, or a fall that would fight with the next rise over a
    // rounding error.
    if (fraction > 0.0 && fraction < 1.0)
      declare_periodic_update({}, period_, delay_ + width_, "fall");
  }

 private:
  void value(const At& at, VectorRef out) const {
    const double k = detail::last_tick(at.time, period_, delay_);
    const bool high = k >= 0.0 && detail::since(at.time, delay_) - k * period_ < width_;
    if (high)
      out = at.parameter(amplitude_);
    else
      out.setZero();
  }

  double period_, width_, delay_;  // [s]
  ParameterIndex amplitude_;
};

}  // namespace saltus
