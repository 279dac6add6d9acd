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
  if (jumped) return {.event = group.name, .obstacle = "the guard jumps across zero"};
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

}  // namespace saltus
