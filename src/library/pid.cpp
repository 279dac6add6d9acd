// v = kp u + i + kd n (u - f), di/dt = ki u, df/dt = n (u - f); y = v, or v between the limits.
#include "saltus/library/pid.hpp"

#include <cmath>

#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

namespace {

/// v; x is (i, f).
template <class At, class Gains>
auto pid_sum(const At& at, const Gains& k) {
  const auto u = at.u(0, 0);
  return at.p(k.kp, 0) * u + at.x(0) + at.p(k.kd, 0) * at.p(k.n, 0) * (u - at.x(1));
}

}  // namespace

PID::PID(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  k_.kp = declare_dynamic_parameter("kp", options.kp);
  k_.ki = declare_dynamic_parameter("ki", options.ki);
  k_.kd = declare_dynamic_parameter("kd", options.kd);
  k_.n = declare_dynamic_parameter("n", options.n);
  declare_parameter_check(detail::positive(k_.n, "n", " 1/s", ": the derivative needs its filter"));
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  if (options.lower_limit || options.upper_limit) declare_limits(options);
  declare_state(options.initial_state);
  declare_output();
}

void PID::declare_limits(const Options& o) {
  const double size = o.lower_limit && o.upper_limit
                          ? *o.upper_limit - *o.lower_limit
                          : o.upper_limit.value_or(0.0) + o.lower_limit.value_or(0.0);
  const double usual = 1e-3 * (size == 0.0 ? 1.0 : std::abs(size));
  const ParameterIndex band = declare_dynamic_parameter("band", o.band.value_or(usual));
  declare_discrete_state(Eigen::VectorXd::Zero((o.lower_limit ? 1 : 0) + (o.upper_limit ? 1 : 0)));
  if (o.lower_limit) declare_limit("lower_limit", *o.lower_limit, -1.0, band);
  if (o.upper_limit) declare_limit("upper_limit", *o.upper_limit, 1.0, band);
  declare_parameter_check(detail::positive(band, "band"));
  if (limits_.size() == 2)
    declare_parameter_check(detail::apart(limits_[0].value, limits_[1].value));
}

/// The integral is clamped where v is beyond the limit while the error pushes outward, and released
/// where v is inside by the band, or the error pushes inward. An error of exactly 0 does neither, so
/// no guard is at zero then, and an error that jumps from 0 is seen.
void PID::declare_limit(const char* parameter, double value, double outward, ParameterIndex band) {
  const Index entry = static_cast<Index>(limits_.size());
  const ParameterIndex limit = declare_dynamic_parameter(parameter, value);
  const auto excess = [k = k_, limit, outward](const auto& at) {
    return outward * (pid_sum(at, k) - at.p(limit, 0));
  };
  const auto guard = [=, k = k_](const auto& at) {
    const auto push = outward * at.p(k.ki, 0) * at.u(0, 0);
    const auto enter = at.choose(push > 0.0, excess(at), -at.p(band, 0));
    const auto leave = at.choose(push < 0.0, at.p(band, 0), -excess(at) - at.p(band, 0));
    return at.choose(at.z(entry) != 0.0, leave, enter);
  };
  declare_zero_crossing({.name = text("clamp_at_", parameter),
                         .reset_map =
                             [entry](const At& at, Next& next) {
                               Eigen::VectorXd z = at.z;
                               z[entry] = 1.0 - z[entry];
                               next.set_discrete_state(z);
                             },
                         .direction = Direction::negative_then_non_negative,
                         .at_start = AtStart::fire,
                         .zeno_tolerance = 0.0,
                         .formula = guard});
  const RelationIndex beyond =
      declare_relation({.name = text("beyond_", parameter), .formula = excess});
  limits_.push_back({entry, outward, limit, beyond});
}

void PID::declare_state(double initial) {
  const bool limited = !limits_.empty();
  declare_continuous_state({.initial = Eigen::Vector2d(initial, 0.0),
                            .reads = Reads::continuous_state | Reads::inputs |
                                     (limited ? Reads::discrete_state : Reads::parameters),
                            .formula = [k = k_, clamps = limits_](const auto& at, Index i) {
                              auto slope = i == 0 ? at.p(k.ki, 0) * at.u(0, 0)
                                                  : at.p(k.n, 0) * (at.u(0, 0) - at.x(1));
                              if (i == 0) {
                                for (const Limit& clamp : clamps)
                                  slope = at.choose(at.z(clamp.entry) != 0.0, 0.0, slope);
                              }
                              return slope;
                            }});
}

void PID::declare_output() {
  const Reads linear = Reads::continuous_state | Reads::inputs;
  declare_output_port({.name = "out",
                       .reads = limits_.empty() ? linear : linear | Reads::relations,
                       .formula = [k = k_, clamps = limits_](const auto& at, Index) {
                         auto y = pid_sum(at, k);
                         for (const Limit& clamp : clamps)
                           y = at.choose(at.relation(clamp.beyond, 0), at.p(clamp.value, 0), y);
                         return y;
                       }});
}

}  // namespace saltus
