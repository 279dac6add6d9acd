// y[k] = sqrt(power / dt) times a normally distributed number, from tick k to the next.
#include "saltus/library/white_noise.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/base/philox.hpp"
#include "saltus/library/detail/parameter_checks.hpp"
#include "saltus/library/detail/schedule.hpp"

namespace saltus {

WhiteNoise::WhiteNoise(std::string name, double dt, const Options& options)
    : LeafSystem(std::move(name)) {
  detail::require_period(this->name(), "dt", dt);
  detail::insist(std::isfinite(options.seed), this->name(), "seed = ", options.seed,
                 "; expected a finite number");
  const ParameterIndex seed = declare_dynamic_parameter("seed", options.seed),
                       power = declare_dynamic_parameter("power", options.power.values);
  declare_seed(seed);
  declare_parameter_check(detail::not_negative(power, "power"));
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
