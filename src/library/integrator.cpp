// dx/dt = u, y = x, elementwise; on a rising edge of reset_trigger x becomes reset_value, or
#include "saltus/library/integrator.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

Integrator::Integrator(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  require_sound(options);
  initial_ = declare_dynamic_parameter("initial_state", options.initial_state.values);
  declare_ports(options);
  if (options.enable_limits) declare_limits(options);
  declare_state(options);
  if (options.enable_reset) declare_reset(options);
}

void Integrator::require_sound(const Options& o) const {
  detail::insist(o.initial_state.values.size() > 0, name(),
                 "initial_state is an empty vector; give at least one number");
  detail::insist(
      o.enable_reset || !o.enable_external_reset, name(),
      "enable_external_reset without enable_reset; a value to reset to needs a trigger: set both");
  detail::insist(!o.zeno_tolerance || *o.zeno_tolerance >= 0.0, name(),
                 "zeno_tolerance = ", o.zeno_tolerance.value_or(0.0),
                 " s; expected a time >= 0 s, where 0 switches the Zeno monitor off");
  if (!o.enable_limits) return;
  detail::insist(o.lower_limit || o.upper_limit, name(),
                 "enable_limits without a limit; give lower_limit, upper_limit or both");
  for (const auto& limit : {o.lower_limit, o.upper_limit}) {
    if (limit)
      detail::require_shape(name(), "a limit", limit->shape(), "initial_state",
                            o.initial_state.shape());
  }
}

void Integrator::declare_ports(const Options& options) {
  const Shape shape = options.initial_state.shape();
  declare_input_port({.name = "in", .shape = shape});
  if (options.enable_reset)
    trigger_ = declare_input_port({.name = "reset_trigger", .shape = Shape::scalar()});
  if (options.enable_external_reset)
    value_ = declare_input_port({.name = "reset_value", .shape = shape});
  if (options.enable_hold)
    hold_ = declare_input_port({.name = "hold_trigger", .shape = Shape::scalar()});
}

/// A state at its limit counts as beyond it, so a state that starts exactly at a limit is held if
/// it is pushed outward.
void Integrator::declare_limits(const Options& options) {
  const Index n = options.initial_state.values.size();
  if (options.lower_limit) {
    lower_ = declare_dynamic_parameter("lower_limit", options.lower_limit->values);
    at_lower_ =
        declare_relation({.name = "at_lower_limit",
                          .true_at_zero = true,
                          .size = n,
                          .reads = Reads::continuous_state,
                          .inputs = std::vector<int>{},
                          .formula = [k = *lower_](const auto& at) { return at.p(k) - at.x(); }});
  }
  if (options.upper_limit) {
    upper_ = declare_dynamic_parameter("upper_limit", options.upper_limit->values);
    at_upper_ =
        declare_relation({.name = "at_upper_limit",
                          .true_at_zero = true,
                          .size = n,
                          .reads = Reads::continuous_state,
                          .inputs = std::vector<int>{},
                          .formula = [k = *upper_](const auto& at) { return at.x() - at.p(k); }});
  }
  if (lower_ && upper_) declare_parameter_check(detail::ordered(*lower_, *upper_));
  rising_ = declare_relation({.name = "rising",
                              .size = n,
                              .reads = Reads::inputs,
                              .inputs = std::vector{0},
                              .formula = [](const auto& at) { return at.u(0); }});
}

/// u, or 0 on hold and for entries that are pushed out of their limits.
Formula Integrator::flow(bool limits) const {
  return [limits, hold = hold_, lower = lower_, upper = upper_, at_lower = at_lower_,
          at_upper = at_upper_, rising = rising_](const auto& at) {
    auto u = at.u(0);
    if (hold) u = at.choose(at.u(*hold, 0) != 0.0, 0.0, u);
    if (!limits) return u;
    const auto up = upper ? at.choose(at.relation(at_upper), 0.0, u) : u;
    const auto down = lower ? at.choose(at.relation(at_lower), 0.0, u) : u;
    return at.choose(at.relation(rising), up, down);
  };
}

void Integrator::declare_state(const Options& options) {
  std::vector<int> inputs{0};
  if (hold_) inputs.push_back(*hold_);
  declare_continuous_state(
      {.initial = options.initial_state.values,
       .reads = options.enable_limits ? Reads::inputs | Reads::relations : Reads::inputs,
       .inputs = std::move(inputs),
       .entries = entry_by_entry,
       .formula = flow(options.enable_limits)});
  const Shape shape = options.initial_state.shape();
  declare_output_port({.name = "out",
                       .shape = shape,
                       .reads = Reads::continuous_state,
                       .view = Place{Space::x, 0, shape.size}});
}

void Integrator::declare_reset(const Options& options) {
  std::vector<int> inputs;
  if (value_) inputs.push_back(*value_);
  declare_edge_reset({.name = "reset",
                      .input = *trigger_,
                      .edge = Edge::rising,
                      .reset_map = &Integrator::reset,
                      .zeno_tolerance = options.zeno_tolerance,
                      .inputs = std::move(inputs)});
}

void Integrator::reset(const At& at, Next& next) const {
  next.set_continuous_state(value_ ? at.u[*value_] : at.parameter(initial_));
}

}  // namespace saltus
