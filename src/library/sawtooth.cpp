// y = amplitude (t - t_k) / period in period k.
#include "saltus/library/sawtooth.hpp"

#include <cmath>

#include "saltus/library/detail/operations.hpp"
#include "saltus/library/detail/schedule.hpp"

namespace saltus {

/// The block holds whether k is even. y is the line of the nearest period of this kind, so it is a
/// line up to half a period beyond a jump.
Sawtooth::Sawtooth(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const double frequency = options.frequency, period = 1.0 / frequency, delay = options.phase_delay;
  detail::insist(frequency > 0.0 && std::isfinite(frequency) && std::isfinite(period), this->name(),
                 "frequency = ", frequency, " 1/s; expected a finite number > 0");
  const ParameterIndex amplitude = declare_dynamic_parameter("amplitude", options.amplitude.values);
  const auto relation = [this](const char* what, auto holds) {
    return declare_relation({.name = what,
                             .guard = [holds](const At& at) { return holds(at) ? 1.0 : -1.0; },
                             .reads = Reads::schedule});
  };
  const RelationIndex even = relation("even_period", [=](const At& at) {
    return std::remainder(detail::last_tick(at.time, period, delay), 2.0) == 0.0;
  });
  const RelationIndex begun =
      relation("begun", [=](const At& at) { return detail::since(at.time, delay) >= 0.0; });
  declare_output_port({.name = "out",
                       .shape = options.amplitude.shape(),
                       .reads = Reads::time | Reads::relations,
                       .formula = [=](const auto& at, Index) {
                         const auto phase = (at.time() - delay) / period;
                         const auto odd = 1.0 - at.relation(even, 0);
                         const auto half = 0.5 * (phase - 0.5 - odd);
                         const auto k = 2.0 * detail::operation(tape::Op::rint, half) + odd;
                         return at.choose(at.relation(begun, 0), at.p(amplitude) * (phase - k),
                                          0.0);
                       }});
  declare_periodic_update({}, period, delay, "jump");
}

}  // namespace saltus
