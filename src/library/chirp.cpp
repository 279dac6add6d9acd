// y = cos(phi + f0 t + (f1 - f0) t^2 / (2 stop_time)), elementwise.
#include "saltus/library/chirp.hpp"

#include <cmath>

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

/// The phase and its first derivative are continuous at stop_time, so both branches have one value
/// for a stage at the end of a step that ends there.
Chirp::Chirp(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  detail::require_period(this->name(), "stop_time", options.stop_time);
  const ParameterIndex f0 = declare_dynamic_parameter("f0", options.f0.values),
                       f1 = declare_dynamic_parameter("f1", options.f1.values),
                       phi = declare_dynamic_parameter("phi", options.phi.values);
  const std::vector<Shape> values{options.f0.shape(), options.f1.shape(), options.phi.shape()};
  declare_output_port({.name = "out",
                       .shape = detail::stretched(this->name(), values),
                       .reads = Reads::time,
                       .formula = [=, end = options.stop_time](const auto& at) {
                         using std::cos;
                         const auto t = at.time();
                         const auto grown = at.choose(t < end, t * t / (2.0 * end), t - 0.5 * end);
                         return cos(at.p(phi) + at.p(f0) * t + (at.p(f1) - at.p(f0)) * grown);
                       }});
  declare_one_shot(options.stop_time, {}, "stop");
}

}  // namespace saltus
