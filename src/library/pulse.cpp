// y = amplitude for phase_delay + k period <= t < phase_delay + (k + pulse_width) period, k = 0, 1,
#include "saltus/library/pulse.hpp"

#include "saltus/library/detail/schedule.hpp"

namespace saltus {

Pulse::Pulse(std::string name, const Options& options)
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
  // If the pulse is always low or always high, it has no fall, or a fall within rounding of the
  // next rise.
  if (fraction > 0.0 && fraction < 1.0)
    declare_periodic_update({}, period_, delay_ + width_, "fall");
}

void Pulse::value(const At& at, VectorRef out) const {
  const double k = detail::last_tick(at.time, period_, delay_);
  const bool high = k >= 0.0 && detail::since(at.time, delay_) - k * period_ < width_;
  if (high)
    out = at.parameter(amplitude_);
  else
    out.setZero();
}

}  // namespace saltus
