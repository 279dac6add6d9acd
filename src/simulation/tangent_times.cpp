// Tangent times: the causes of an instant, and where a guard grazes zero.
#include "saltus/simulation/detail/tangent_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

namespace {

constexpr double no_derivative = std::numeric_limits<double>::quiet_NaN();
/// The rounding of a sum such as dg/dx f + dg/dt, in parts of its terms.
constexpr double sum_rounding = 1e3 * thresholds::eps;

/// Derivatives that differ by no more than this part are the same, see `moves_apart`.
constexpr double same_time = 1e-6;

}  // namespace

bool moves_apart(double a, double b) {
  return std::abs(a - b) > same_time * std::max(std::abs(a), std::abs(b));
}

/// With the speed s and the curvature c against it, the function goes beyond zero by s^2 / (2 |c|). The
/// error of its value follows from the tolerances of the states that it reads.
bool grazes(const GuardTangent& of, double speed, const ZeroPlace& at,
            const std::function<Eigen::VectorXd(double, const double*)>& flow,
            const std::function<GuardTangent(double, const double*)>& tangent) {
  const Eigen::VectorXd& f = at.flow;
  const double terms = of.by_state.cwiseAbs().dot(f.cwiseAbs()) + std::abs(of.by_time);
  if (!(std::abs(speed) > sum_rounding * terms)) return true;
  double error = 0.0;
  for (Index i = 0; i < f.size(); ++i)
    error +=
        std::abs(of.by_state[i]) * (at.options.atol[i] + at.options.rtol[i] * std::abs(at.x[i]));
  const double ahead = std::sqrt(2.0 * error / terms / std::max(terms, 1.0));
  if (!(ahead > 0.0) || !std::isfinite(ahead)) return false;
  const Eigen::VectorXd later = VectorView(at.x, f.size()) + ahead * f;
  const GuardTangent there = tangent(at.t + ahead, later.data());
  const double curvature =
      (there.by_state.dot(flow(at.t + ahead, later.data())) + there.by_time - speed) / ahead;
  return curvature * speed < 0.0 && speed * speed <= 2.0 * std::abs(curvature) * error;
}

MovedTime TangentTimes::of(const Firing& firing, bool jumped, const TangentColumns& until,
                           double t) {
  const Guard& guard = (*guards_)[firing.guard()];
  const GuardGroup& group = machine_->plan().guard(guard.group);
  if (guard.phase == Phase::resting || guard.phase == Phase::carried ||
      firing.from == Firing::lifts_off)
    return {.event = group.name, .obstacle = "the guard was at rest"};
  if (group.is_opaque())
    return {.event = group.name,
            .obstacle = "a called function decides it, which shows a sign only"};
  if (jumped) return of_jump(firing.slot, group.name, t, until);
  return of_crossing(firing.slot, group.name, t, machine_->x.data(), until);
}

MovedTime TangentTimes::of(const ScheduledEvent& event, const TangentColumns& until) {
  MovedTime moved{.by = Eigen::RowVectorXd::Zero(until.size()), .event = event.name};
  if (!event.by_state) return moved;
  const PlanLeaf& leaf = machine_->plan().leaf(event.leaf);
  const auto& next = machine_->plan().time_event_of(event).next;
  const auto read = [&](Machine& probe, double, double* out) {
    *out = next(VectorView(probe.z.data() + leaf.z, leaf.nz));
  };
  for (Index k = 0; k < until.size(); ++k)
    probe_->derivative(machine_->x.data(), until.column(k), 1, read, &moved.by[k]);
  return moved;
}

MovedTime TangentTimes::of_crossing(Index slot, const std::string& event, double t, const double* x,
                                    const TangentColumns& until) {
  const GuardTangent guard = flow_->guard(t, x, slot, until);
  const double speed = guard.by_state.dot(probe_->flow(t, x)) + guard.by_time;
  MovedTime moved{.by = until.t - guard.columns / speed, .event = event};
  if (!guard.columns.allFinite() || !std::isfinite(speed))
    moved.doubt = "the derivative of the guard is not finite";
  const bool flat = guard.by_state.isZero(0.0) && guard.by_time == 0.0;
  const auto flow = [&](double at, const double* state) { return probe_->flow(at, state); };
  const auto tangent = [&](double at, const double* state) {
    return flow_->guard(at, state, slot, until);
  };
  const bool at_rest = grazes(guard, speed, {t, x, probe_->flow(t, x), *options_}, flow, tangent);
  for (Index k = 0; k < until.size(); ++k) {
    // A guard that does not depend on the parameter has a time all the same.
    const bool independent = flat ? !until.matters(k) : guard.columns[k] == 0.0;
    if (at_rest) moved.by[k] = independent ? until.t[k] : no_derivative;
  }
  return moved;
}

/// A guard that is an expression jumps where one of its comparisons or steps is at its limit, as a truth
/// that is 1 or -1. Several of them have to move alike.
MovedTime TangentTimes::of_jump(Index slot, const std::string& event, double t,
                                const TangentColumns& until) {
  MovedTime found{.event = event, .obstacle = "the guard jumps across zero"};
  TangentFlow::GuardSwitches* switches = flow_->switches_of_guard(slot);
  if (switches == nullptr) return found;
  const double* x = machine_->x.data();
  const Eigen::VectorXd flow = probe_->flow(t, x);
  Eigen::VectorXd numbers(switches->numbers.size());
  flow_->variables().at(t, x,
                        [&](const At& at) { switches->numbers.evaluate(at, numbers.data()); });
  for (Index k = 0; k < numbers.size() / tape::numbers_of_switch; ++k) {
    const GuardTangent residual = flow_->exact_row(switches->residuals, t, x, k, until);
    const double* of_switch = &numbers[k * tape::numbers_of_switch];
    if (!is_at_limit(of_switch, residual, t, x)) continue;
    const double speed = std::abs(residual.by_state.dot(flow) + residual.by_time);
    if (!changes_sign(slot, t, flow, sum_rounding * of_switch[2] / speed)) continue;
    const MovedTime one = of_residual(residual, event, flow, until);
    const bool first = !found.obstacle.empty();
    if (first) found = one;
    for (Index i = 0; i < until.size() && !first; ++i)
      if (std::isnan(one.by[i]) || moves_apart(found.by[i], one.by[i])) found.by[i] = no_derivative;
  }
  found.doubt = "the guard jumps across zero, and only grazes that place, or two of its jumps meet";
  return found;
}

/// Whether a guard changes its sign by the time and the flow alone, and not by what else happens at t.
bool TangentTimes::changes_sign(Index slot, double t, const Eigen::VectorXd& flow, double away) {
  const double beside =
      std::max(away, thresholds::roundings_beside_jump * thresholds::eps * std::abs(t));
  if (!std::isfinite(beside)) return false;
  Eigen::VectorXd g(machine_->plan().look_slots);
  const auto guard_at = [&](double shift) {
    const Eigen::VectorXd x = machine_->x + shift * flow;
    Machine& probe = probe_->at(x.data());
    probe.guards_at(t + shift, probe.x.data(), g.data());
    return g[slot];
  };
  return (guard_at(-beside) > 0.0) != (guard_at(beside) > 0.0);
}

MovedTime TangentTimes::of_residual(const GuardTangent& residual, const std::string& event,
                                    const Eigen::VectorXd& flow,
                                    const TangentColumns& until) const {
  const double speed = residual.by_state.dot(flow) + residual.by_time;
  const double terms =
      residual.by_state.cwiseAbs().dot(flow.cwiseAbs()) + std::abs(residual.by_time);
  MovedTime moved{.by = until.t, .event = event};
  for (Index k = 0; k < until.size(); ++k) {
    if (residual.columns[k] == 0.0) continue;
    const bool clear = std::abs(speed) > sum_rounding * terms && std::isfinite(speed);
    moved.by[k] = clear ? until.t[k] - residual.columns[k] / speed : no_derivative;
  }
  return moved;
}

}  // namespace saltus
