// y[k] = y[k-1] + dt (w u[k] + (1 - w) u[k-1]), elementwise.
#include "saltus/library/integrator_discrete.hpp"

#include <algorithm>

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/parameter_checks.hpp"
#include "saltus/library/detail/words.hpp"
#include "saltus/library/integrator.hpp"

namespace saltus {

namespace {

double weight_of(const std::string& block, std::string_view method) {
  constexpr std::pair<std::string_view, double> weights[] = {
      {"forward", 0.0}, {"backward", 1.0}, {"trapezoidal", 0.5}};
  return detail::meaning(block, "method", method, weights);
}

/// Refuses options that do not go together, by the checks and the messages of an Integrator.
void require_sound_integrator(const std::string& block, const IntegratorDiscreteOptions& o) {
  Integrator(block, {.initial_state = o.initial_state,
                     .enable_reset = o.enable_reset,
                     .enable_external_reset = o.enable_external_reset,
                     .enable_limits = o.enable_limits,
                     .lower_limit = o.lower_limit,
                     .upper_limit = o.upper_limit});
}

/// s = (y without the part of u[k]; truth of the trigger at the last tick, -1: there was none).
struct IntegratorRule {
  double dt, weight;
  ParameterIndex initial = {};
  std::optional<int> trigger = {}, value = {}, hold = {};  // inputs
  std::optional<ParameterIndex> lower = {}, upper = {};

  /// At the first tick every method shows the state unchanged.
  bool starts(const VectorView& s) const { return s[s.size() - 1] < 0.0; }
  bool resets(const At& at, const VectorView& s) const {
    return trigger && at.u(*trigger) != 0.0 && s[s.size() - 1] == 0.0;
  }
  void add(const At& at, double part, VectorRef y) const {
    if (!hold || at.u(*hold) == 0.0) y += part * dt * at.u[0];
  }
  void limit(const At& at, VectorRef y) const {
    for (Index i = 0; i < y.size(); ++i) {
      if (lower) y[i] = std::max(y[i], detail::entry(at.parameter(*lower), i));
      if (upper) y[i] = std::min(y[i], detail::entry(at.parameter(*upper), i));
    }
  }
  void output(const At& at, const VectorView& s, VectorRef y) const {
    if (resets(at, s)) {
      y = value ? at.u[*value] : at.parameter(initial);
    } else {
      y = s.head(y.size());
      if (weight > 0.0 && !starts(s)) add(at, weight, y);
    }
    limit(at, y);
  }
  void next(const At& at, const VectorView& s, VectorRef next) const {
    const VectorRef y(next.data(), next.size() - 1);
    output(at, s, y);
    if (weight < 1.0) add(at, 1.0 - weight, y);
    if (weight == 0.0) limit(at, y);  // else the output does, when the part of u[k] is known
    next[next.size() - 1] = trigger && at.u(*trigger) != 0.0 ? 1.0 : 0.0;
  }
};

/// The inputs that the output reads at its own tick.
std::vector<int> feedthrough_of(const IntegratorRule& rule) {
  std::vector<int> through;
  if (rule.weight > 0.0) through.push_back(0);
  if (rule.trigger) through.push_back(*rule.trigger);
  if (rule.value) through.push_back(*rule.value);
  if (rule.weight > 0.0 && rule.hold) through.push_back(*rule.hold);
  return through;
}

}  // namespace

IntegratorDiscrete::IntegratorDiscrete(std::string name, double dt, const Options& o)
    : SampledSystem(std::move(name)) {
  require_sound_integrator(this->name(), o);
  const Shape shape = o.initial_state.shape();
  IntegratorRule rule{.dt = dt, .weight = weight_of(this->name(), o.method)};
  rule.initial = declare_dynamic_parameter("initial_state", o.initial_state.values);
  declare_input_port({.name = "in", .shape = shape});
  const auto port = [&](const char* what, const Shape& of) {
    return declare_input_port({.name = what, .shape = of});
  };
  if (o.enable_reset) rule.trigger = port("reset_trigger", Shape::scalar());
  if (o.enable_external_reset) rule.value = port("reset_value", shape);
  if (o.enable_hold) rule.hold = port("hold_trigger", Shape::scalar());
  if (o.enable_limits && o.lower_limit)
    rule.lower = declare_dynamic_parameter("lower_limit", o.lower_limit->values);
  if (o.enable_limits && o.upper_limit)
    rule.upper = declare_dynamic_parameter("upper_limit", o.upper_limit->values);
  if (rule.lower && rule.upper) declare_parameter_check(detail::ordered(*rule.lower, *rule.upper));
  Eigen::VectorXd start(shape.size + 1);
  start << o.initial_state.values, -1.0;
  declare_law(
      {.dt = dt,
       .before = o.initial_state,
       .state = start,
       .feedthrough = feedthrough_of(rule),
       .output = [rule](const At& at, const VectorView& s, VectorRef y) { rule.output(at, s, y); },
       .next = [rule](const At& at, const VectorView& s,
                      VectorRef next) { rule.next(at, s, next); }});
}

}  // namespace saltus
