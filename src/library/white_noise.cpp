// y[k] = sqrt(power / dt) times a normally distributed number, from tick k to the next.
#include "saltus/library/white_noise.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/base/philox.hpp"
#include "saltus/library/detail/schedule.hpp"

namespace saltus {

WhiteNoise::WhiteNoise(std::string name, double dt, const Options& options)
    : LeafSystem(std::move(name)) {
  detail::require_period(this->name(), "dt", dt);
  for (const double each : options.power.values)
    detail::insist(each >= 0.0, this->name(), "power = ", each, "; expected a number >= 0");
  detail::insist(std::isfinite(options.seed), this->name(), "seed = ", options.seed,
                 "; expected a finite number");
  const ParameterIndex seed = declare_dynamic_parameter("seed", options.seed),
                       power = declare_dynamic_parameter("power", options.power.values);
  declare_output_port({.name = "out",
                       .calc =
                           [=](const At& at, VectorRef out) {
                             const double tick = std::max(0.0, detail::last_tick(at.time, dt));
                             for (Index i = 0; i < out.size(); ++i)
                               out[i] = std::sqrt(at.parameter(power)[i] / dt) *
                                        detail::normal(detail::random_words(at.p[seed], tick, i));
                           },
                       .shape = options.power.shape(),
                       .reads = Reads::schedule});
  declare_periodic_update({}, dt, 0.0, "tick");
}

}  // namespace saltus
