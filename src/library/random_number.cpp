// y[k] = a random number, from tick k to the next; one for each entry, independent.
#include "saltus/library/random_number.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/base/philox.hpp"
#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/parameter_checks.hpp"
#include "saltus/library/detail/schedule.hpp"

namespace saltus {

namespace {

detail::Words words_of(const At& at, ParameterIndex seed, double dt, Index entry) {
  const double tick = std::max(0.0, detail::last_tick(at.time, dt));
  return detail::random_words(at.p[seed], tick, entry);
}

}  // namespace

RandomNumber::RandomNumber(std::string name, double dt, const Options& options)
    : LeafSystem(std::move(name)) {
  detail::require_period(this->name(), "dt", dt);
  detail::require_known(this->name(), "distribution", options.distribution, {"normal", "uniform"});
  detail::insist(std::isfinite(options.seed), this->name(), "seed = ", options.seed,
                 "; expected a finite number");
  options.distribution == "normal" ? declare_normal(dt, options) : declare_uniform(dt, options);
  declare_periodic_update({}, dt, 0.0, "tick");
}

void RandomNumber::declare_normal(double dt, const Options& o) {
  const ParameterIndex seed = declare_dynamic_parameter("seed", o.seed),
                       mean = declare_dynamic_parameter("mean", o.mean.values),
                       deviation = declare_dynamic_parameter("standard_deviation",
                                                             o.standard_deviation.values);
  declare_seed(seed);
  declare_parameter_check(detail::not_negative(deviation, "standard_deviation"));
  const std::vector<Shape> shapes{o.mean.shape(), o.standard_deviation.shape()};
  declare_output_port({.name = "out",
                       .calc =
                           [=](const At& at, VectorRef out) {
                             for (Index i = 0; i < out.size(); ++i)
                               out[i] = detail::entry(at.parameter(mean), i) +
                                        detail::entry(at.parameter(deviation), i) *
                                            detail::normal(words_of(at, seed, dt, i));
                           },
                       .shape = detail::stretched(name(), shapes),
                       .reads = Reads::schedule});
}

void RandomNumber::declare_uniform(double dt, const Options& o) {
  const ParameterIndex seed = declare_dynamic_parameter("seed", o.seed),
                       lower = declare_dynamic_parameter("lower_limit", o.lower_limit.values),
                       upper = declare_dynamic_parameter("upper_limit", o.upper_limit.values);
  declare_seed(seed);
  declare_parameter_check(detail::ordered(lower, upper));
  const std::vector<Shape> shapes{o.lower_limit.shape(), o.upper_limit.shape()};
  declare_output_port({.name = "out",
                       .calc =
                           [=](const At& at, VectorRef out) {
                             for (Index i = 0; i < out.size(); ++i) {
                               const double low = detail::entry(at.parameter(lower), i),
                                            high = detail::entry(at.parameter(upper), i);
                               out[i] =
                                   low + (high - low) * detail::uniform(words_of(at, seed, dt, i));
                             }
                           },
                       .shape = detail::stretched(name(), shapes),
                       .reads = Reads::schedule});
}

}  // namespace saltus
