// d2x/dt2 = u: position x and velocity dx, elementwise; at a limit of x the body stops, or rebounds.
#include "saltus/library/second_order_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

namespace {

/// [of 1 and of a limit] How far a state may be beyond its limit: a run leaves a velocity beyond it by its
/// last move within the resolution of the time.
constexpr double beyond_limit = 1e-9;

/// The check of n entries of the state, from `first` on, against a limit.
StartCheck begins_inside(std::string state, std::string limit, ParameterIndex k, double outward,
                         Index first, Index n) {
  return [=](const std::string& block, double t, const VectorView& x,
             const ParameterValues& values) {
    for (Index i = 0; i < n; ++i) {
      const double value = x[first + i], bound = detail::entry(values.vector(k), i);
      const double room = beyond_limit * (1.0 + std::abs(bound));
      detail::insist(!(outward * (value - bound) > room), block, "at the start of the run, t = ", t,
                     " s, ", state, "[", i, "] = ", value, " is ",
                     outward > 0.0 ? "above " : "below ", limit, " ", bound,
                     "; begin at the limit or inside it, or change the parameter '", limit, "'");
    }
  };
}

void require_restitution(const std::string& block, double found) {
  detail::insist(found >= 0.0 && found <= 1.0, block, "restitution = ", found, "; expected 0 to 1");
}

}  // namespace

SecondOrderIntegrator::SecondOrderIntegrator(std::string name, const Options& options)
    : LeafSystem(std::move(name)), n_(options.initial_position.values.size()) {
  require_sound(options);
  const Shape shape = options.initial_position.shape();
  declare_input_port({.name = "in", .shape = shape});
  declare_motion(options);
  declare_output_port({.name = "x",
                       .shape = shape,
                       .reads = Reads::continuous_state,
                       .view = Place{Space::x, 0, n_}});
  declare_output_port({.name = "dx",
                       .shape = shape,
                       .reads = Reads::continuous_state,
                       .view = Place{Space::x, n_, n_}});
  if (options.lower_limit || options.upper_limit) declare_limits(options);
  require_inside(options);
}

void SecondOrderIntegrator::declare_limits(const Options& options) {
  const ParameterIndex restitution = declare_dynamic_parameter("restitution", options.restitution);
  declare_parameter_check([restitution](const std::string& block, const ParameterValues& p) {
    require_restitution(block, p[restitution]);
  });
  std::optional<ParameterIndex> lower, upper;
  if (options.lower_limit)
    lower = declare_limit("lower_limit", *options.lower_limit, -1.0, restitution);
  if (options.upper_limit)
    upper = declare_limit("upper_limit", *options.upper_limit, 1.0, restitution);
  if (lower && upper) declare_parameter_check(detail::ordered(*lower, *upper));
}

/// d(x, dx)/dt = (dx, u), where u is 0 for an entry that is pushed beyond a limit of dx.
void SecondOrderIntegrator::declare_motion(const Options& options) {
  Eigen::VectorXd initial(2 * n_);
  initial.head(n_) = options.initial_position.values;
  for (Index i = 0; i < n_; ++i)
    initial[n_ + i] = detail::entry(
        {options.initial_velocity.values.data(), options.initial_velocity.values.size()}, i);
  std::optional<RelationIndex> slow, fast, pushed_up;
  if (options.lower_velocity_limit)
    slow = declare_velocity_limit("lower_velocity_limit", "at_lower_velocity_limit",
                                  *options.lower_velocity_limit, -1.0);
  if (options.upper_velocity_limit)
    fast = declare_velocity_limit("upper_velocity_limit", "at_upper_velocity_limit",
                                  *options.upper_velocity_limit, 1.0);
  if (slow && fast)
    declare_parameter_check(detail::ordered(*slowest_, *fastest_, "", "velocity_limit"));
  if (!slow && !fast) {
    declare_continuous_state({.initial = initial,
                              .reads = Reads::continuous_state | Reads::inputs,
                              .formula = [n = n_](const auto& at, Index i) {
                                return i < n ? at.x(n + i) : at.u(0, i - n);
                              }});
    return;
  }
  pushed_up = declare_relation(
      {.name = "rising", .size = n_, .reads = Reads::inputs, .formula = [](const auto& at) {
         return at.u(0);
       }});
  declare_continuous_state(
      {.initial = initial,
       .reads = Reads::continuous_state | Reads::inputs | Reads::relations,
       .formula = [n = n_, slow, fast, up = *pushed_up](const auto& at, Index i) {
         if (i < n) return at.x(n + i);
         const Index j = i - n;
         const auto u = at.u(0, j);
         const auto rising = fast ? at.choose(at.relation(*fast, j), 0.0, u) : u;
         const auto falling = slow ? at.choose(at.relation(*slow, j), 0.0, u) : u;
         return at.choose(at.relation(up, j), rising, falling);
       }});
}

RelationIndex SecondOrderIntegrator::declare_velocity_limit(const char* parameter,
                                                            const char* relation,
                                                            const Value& limit, double outward) {
  const ParameterIndex k = declare_dynamic_parameter(parameter, limit.values);
  (outward > 0.0 ? fastest_ : slowest_) = k;
  declare_start_check(begins_inside("dx", parameter, k, outward, n_, n_));
  return declare_relation({.name = relation,
                           .true_at_zero = true,
                           .size = n_,
                           .reads = Reads::continuous_state,
                           .inputs = std::vector<int>{},
                           .formula = [k, outward, n = n_](const auto& at, Index i) {
                             return outward * (at.x(n + i) - at.p(k, k.size == 1 ? 0 : i));
                           }});
}

void SecondOrderIntegrator::require_sound(const Options& o) const {
  detail::insist(n_ > 0, name(), "initial_position is an empty vector; give at least one number");
  require_restitution(name(), o.restitution);
  const auto require_shape = [&](const char* what, const std::optional<Value>& value) {
    if (value)
      detail::require_shape(name(), what, value->shape(), "initial_position",
                            o.initial_position.shape());
  };
  require_shape("initial_velocity", o.initial_velocity);
  require_shape("lower_limit", o.lower_limit);
  require_shape("upper_limit", o.upper_limit);
  require_shape("lower_velocity_limit", o.lower_velocity_limit);
  require_shape("upper_velocity_limit", o.upper_velocity_limit);
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
    const double v = of(o.initial_velocity, 0.0);
    detail::insist(v >= of(o.lower_velocity_limit, v) && v <= of(o.upper_velocity_limit, v), name(),
                   "initial_velocity ", v, " is outside the limits; expected a start between them");
  }
}

ParameterIndex SecondOrderIntegrator::declare_limit(const char* parameter, const Value& limit,
                                                    double outward, ParameterIndex restitution) {
  const ParameterIndex k = declare_dynamic_parameter(parameter, limit.values);
  declare_start_check(begins_inside("x", parameter, k, outward, 0, n_));
  std::vector<std::vector<int>> rests;
  for (int i = 0; i < static_cast<int>(n_); ++i) rests.push_back({i, static_cast<int>(n_) + i});
  const auto stop = [=, n = n_, slowest = slowest_, fastest = fastest_](const At& at, Next& next) {
    Eigen::VectorXd x = at.x;
    x[at.entry] = detail::entry(at.parameter(k), at.entry);
    double& v = x[n + at.entry];
    v *= -at.parameter(restitution)[0];
    if (slowest) v = std::max(v, detail::entry(at.parameter(*slowest), at.entry));
    if (fastest) v = std::min(v, detail::entry(at.parameter(*fastest), at.entry));
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
  return k;
}

}  // namespace saltus
