// d2x/dt2 = u: position x and velocity dx, elementwise; at a limit of x the body stops, or rebounds.
#include "saltus/library/second_order_integrator.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

SecondOrderIntegrator::SecondOrderIntegrator(std::string name, const Options& options)
    : LeafSystem(std::move(name)), n_(options.initial_position.values.size()) {
  require_sound(options);
  require_inside(options);
  const Shape shape = options.initial_position.shape();
  declare_input_port({.name = "in", .shape = shape});
  Eigen::VectorXd initial(2 * n_);
  initial.head(n_) = options.initial_position.values;
  for (Index i = 0; i < n_; ++i)
    initial[n_ + i] = detail::entry(
        {options.initial_velocity.values.data(), options.initial_velocity.values.size()}, i);
  declare_continuous_state({.initial = initial,
                            .reads = Reads::continuous_state | Reads::inputs,
                            .formula = [n = n_](const auto& at, Index i) {
                              return i < n ? at.x(n + i) : at.u(0, i - n);
                            }});
  declare_output_port({.name = "x",
                       .shape = shape,
                       .reads = Reads::continuous_state,
                       .view = Place{Space::x, 0, n_}});
  declare_output_port({.name = "dx",
                       .shape = shape,
                       .reads = Reads::continuous_state,
                       .view = Place{Space::x, n_, n_}});
  if (!options.lower_limit && !options.upper_limit) return;
  const ParameterIndex restitution = declare_dynamic_parameter("restitution", options.restitution);
  if (options.lower_limit) declare_limit("lower_limit", *options.lower_limit, -1.0, restitution);
  if (options.upper_limit) declare_limit("upper_limit", *options.upper_limit, 1.0, restitution);
}

void SecondOrderIntegrator::require_sound(const Options& o) const {
  detail::insist(n_ > 0, name(), "initial_position is an empty vector; give at least one number");
  detail::insist(o.restitution >= 0.0 && o.restitution <= 1.0, name(),
                 "restitution = ", o.restitution, "; expected 0 to 1");
  if (o.lower_limit && o.upper_limit)
    detail::require_ordered(name(), *o.lower_limit, *o.upper_limit);
  for (const auto& [what, value] :
       {std::pair{"initial_velocity", std::optional(o.initial_velocity)},
        std::pair{"lower_limit", o.lower_limit}, std::pair{"upper_limit", o.upper_limit}}) {
    const Index found = value ? value->values.size() : 1;
    detail::insist(found == 1 || found == n_, name(), what, " has ", found,
                   " values, initial_position has ", n_, "; expected one value or as many");
  }
}

/// Throws ModelError for an entry that starts beyond a limit.
void SecondOrderIntegrator::require_inside(const Options& o) const {
  for (Index i = 0; i < n_; ++i) {
    const auto of = [i](const std::optional<Value>& v, double otherwise) {
      return v ? v->values[v->values.size() == 1 ? 0 : i] : otherwise;
    };
    const double x = o.initial_position.values[i];
    detail::insist(x >= of(o.lower_limit, x) && x <= of(o.upper_limit, x), name(),
                   "initial_position ", x, " is outside the limits; expected a start between them");
  }
}

void SecondOrderIntegrator::declare_limit(const char* parameter, const Value& limit, double outward,
                                          ParameterIndex restitution) {
  const ParameterIndex k = declare_dynamic_parameter(parameter, limit.values);
  std::vector<std::vector<int>> rests;
  for (int i = 0; i < static_cast<int>(n_); ++i) rests.push_back({i, static_cast<int>(n_) + i});
  const auto stop = [=, n = n_](const At& at, Next& next) {
    Eigen::VectorXd x = at.x;
    x[at.entry] = detail::entry(at.parameter(k), at.entry);
    x[n + at.entry] *= -at.parameter(restitution)[0];
    next.set_continuous_state(x);
  };
  declare_zero_crossing({.name = parameter,
                         .reset_map = stop,
                         .direction = Direction::negative_then_non_negative,
                         .size = n_,
                         .holds = rests,
                         .inputs = std::vector<int>{},
                         .formula = [k, outward](const auto& at, Index i) {
                           return outward * (at.x(i) - at.p(k, k.size == 1 ? 0 : i));
                         }});
}

}  // namespace saltus
