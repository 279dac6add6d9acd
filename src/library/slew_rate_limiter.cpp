// dy/dt = min(max((u - y) / time_constant, lower_limit), upper_limit), elementwise.
#include "saltus/library/slew_rate_limiter.hpp"

namespace saltus {

SlewRateLimiter::SlewRateLimiter(std::string name, const Options& options)
    : LeafSystem(std::move(name)) {
  const Shape shape = options.initial_state.shape();
  const ParameterIndex lower = declare_dynamic_parameter("lower_limit", options.lower_limit);
  const ParameterIndex upper = declare_dynamic_parameter("upper_limit", options.upper_limit);
  const ParameterIndex lag = declare_dynamic_parameter("time_constant", options.time_constant);
  declare_parameter_check([=](const std::string& block, const ParameterValues& p) {
    detail::require_period(block, "time_constant", p[lag]);
    detail::insist(p[lower] <= 0.0 && p[upper] >= 0.0, block, "lower_limit ", p[lower],
                   " /s, upper_limit ", p[upper], " /s; expected lower_limit <= 0 <= upper_limit");
  });
  declare_input_port({.name = "in", .shape = shape});
  const auto limit = [&](const char* relation, ParameterIndex rate, double outward) {
    return declare_relation({.name = relation,
                             .size = shape.size,
                             .reads = Reads::continuous_state | Reads::inputs,
                             .formula = [=](const auto& at, Index i) {
                               return outward *
                                      (at.u(0, i) - at.x(i) - at.p(lag, 0) * at.p(rate, 0));
                             }});
  };
  const RelationIndex too_fast = limit("too_fast", upper, 1.0),
                      too_slow = limit("too_slow", lower, -1.0);
  declare_continuous_state({.initial = options.initial_state.values,
                            .reads = Reads::continuous_state | Reads::inputs | Reads::relations,
                            .entries = entry_by_entry,
                            .formula = [=](const auto& at) {
                              const auto free = (at.u(0) - at.x()) / at.p(lag);
                              const auto limited =
                                  at.choose(at.relation(too_slow), at.p(lower), free);
                              return at.choose(at.relation(too_fast), at.p(upper), limited);
                            }});
  declare_output_port({.name = "out",
                       .shape = shape,
                       .reads = Reads::continuous_state,
                       .view = Place{Space::x, 0, shape.size}});
}

}  // namespace saltus
