// v[k] = kp u[k] + i[k] + kd d[k], y[k] = v[k], or v[k] between the limits.
#include "saltus/library/pid_discrete.hpp"

#include <algorithm>

#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

namespace {

/// s = (i, f, whether there was a tick).
struct PIDRule {
  double dt;
  ParameterIndex kp = {}, ki = {}, kd = {}, n = {};
  std::optional<ParameterIndex> lower = {}, upper = {};

  double slope(const At& at, const VectorView& s) const {
    return s[2] == 0.0 ? 0.0 : at.p[n] / (1.0 + at.p[n] * dt) * (at.u(0) - s[1]);
  }
  double sum(const At& at, const VectorView& s) const {
    return at.p[kp] * at.u(0) + s[0] + at.p[kd] * slope(at, s);
  }
  bool clamped(const At& at, const VectorView& s) const {
    const double v = sum(at, s), push = at.p[ki] * at.u(0);
    return (lower && v < at.p[*lower] && push < 0.0) || (upper && v > at.p[*upper] && push > 0.0);
  }
  void output(const At& at, const VectorView& s, VectorRef y) const {
    y[0] = sum(at, s);
    if (lower) y[0] = std::max(y[0], at.p[*lower]);
    if (upper) y[0] = std::min(y[0], at.p[*upper]);
  }
  void next(const At& at, const VectorView& s, VectorRef next) const {
    next[0] = clamped(at, s) ? s[0] : s[0] + at.p[ki] * dt * at.u(0);
    next[1] = s[2] == 0.0 ? at.u(0) : s[1] + dt * slope(at, s);
    next[2] = 1.0;
  }
};

}  // namespace

PIDDiscrete::PIDDiscrete(std::string name, double dt, const Options& o)
    : SampledSystem(std::move(name)) {
  PIDRule rule{.dt = dt};
  rule.kp = declare_dynamic_parameter("kp", o.kp);
  rule.ki = declare_dynamic_parameter("ki", o.ki);
  rule.kd = declare_dynamic_parameter("kd", o.kd);
  rule.n = declare_dynamic_parameter("n", o.n);
  if (o.lower_limit) rule.lower = declare_dynamic_parameter("lower_limit", *o.lower_limit);
  if (o.upper_limit) rule.upper = declare_dynamic_parameter("upper_limit", *o.upper_limit);
  declare_parameter_check(detail::positive(rule.n, "n", " 1/s"));
  if (rule.lower && rule.upper) declare_parameter_check(detail::apart(*rule.lower, *rule.upper));
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  declare_law(
      {.dt = dt,
       .before = o.initial_state,
       .state = Eigen::Vector3d(o.initial_state, 0.0, 0.0),
       .feedthrough = {0},
       .output = [rule](const At& at, const VectorView& s, VectorRef y) { rule.output(at, s, y); },
       .next = [rule](const At& at, const VectorView& s,
                      VectorRef next) { rule.next(at, s, next); }});
}

}  // namespace saltus
