// FlowSwitches: the changes of branches in a step, and the jump that each of them makes.
#include "saltus/simulation/detail/flow_switches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/kinks.hpp"
#include "saltus/simulation/detail/tangent_times.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

namespace {

constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
const char* const only_grazes =
    "the flow jumps without an event, and its branch only grazes the limit, or the flow leads "
    "back; "
    "write the branch as a relation, or as modes with a guard";
const char* const without_root =
    "the flow jumps without an event; write the branch as a relation, or as modes with a guard";
const char* const two_at_once =
    "the flow jumps twice at the same time without an event, and the order would change";

/// Rounding, in parts of a residual's terms and of their movement in a rounding of time.
constexpr double residual_rounding = 1e3 * thresholds::eps;

}  // namespace

/// The last and the first times with different branches, one after the other.
void FlowSwitches::narrow(double from, double to, const StateAt& state,
                          std::vector<Change>& found) {
  while (here_ != there_ && found.size() < thresholds::most_changes) {
    double before = from, after = to;
    for (;;) {
      const double middle = before + 0.5 * (after - before);
      if (!(before < middle && middle < after)) break;
      flow_->branches_at(middle, state(middle).data(), middle_);
      (middle_ == here_ ? before : after) = middle;
    }
    found.push_back({before, after});
    flow_->branches_at(after, state(after).data(), here_);
    from = after;
  }
}

std::vector<FlowSwitches::Change> FlowSwitches::changes(double from, double to,
                                                        const StateAt& state) {
  std::vector<Change> found;
  flow_->branches_at(from, state(from).data(), here_);
  double last = from;
  for (const double part : thresholds::looks_at_branches) {
    const double next = part == 1.0 ? to : from + part * (to - from);
    flow_->branches_at(next, state(next).data(), there_);
    narrow(last, next, state, found);
    last = next;
  }
  return found;
}

/// Whether a change is more than the rounding of the rates; a kink is none.
bool FlowSwitches::is_jump(const Eigen::VectorXd& f_minus, const Eigen::VectorXd& f_plus) {
  bool jumps = false;
  for (Index i = 0; i < rates_.size(); ++i) {
    rates_[i] = std::max({rates_[i], std::abs(f_minus[i]), std::abs(f_plus[i])});
    jumps = jumps || !(std::abs(f_minus[i] - f_plus[i]) <= thresholds::least_jump * rates_[i]);
  }
  return jumps;
}

bool FlowSwitches::is_at_limit(Index number, double t, const double* x,
                               const GuardTangent& residual) {
  const double* numbers = flow_->switches_at(t, x) + number * tape::numbers_of_switch;
  return saltus::is_at_limit(numbers, residual, t, x);
}

/// Whether the flow takes the branch across its limit, on both sides of it, with a speed that is clear.
bool FlowSwitches::passes(const GuardTangent& residual, Index number, double t, const double* x,
                          const Eigen::VectorXd& f_minus, const Eigen::VectorXd& f_plus,
                          const TangentColumns& columns) {
  const double speed = residual.by_state.dot(f_minus) + residual.by_time,
               ahead = residual.by_state.dot(f_plus) + residual.by_time;
  if (!std::isfinite(speed) || !(speed * ahead > 0.0)) return false;
  const auto tangent = [&](double at, const double* state) {
    return flow_->of_switch(at, state, number, columns);
  };
  const auto flow = [&](double at, const double* state) {
    return flow_->rates_of_branch(at, state);
  };
  return !grazes(residual, speed, {t, x, f_minus, *options_}, flow, tangent);
}

/// Takes one cause of a jump. All of them have to move alike.
void FlowSwitches::take(Index number, double t, const double* x, const Eigen::VectorXd& f_minus,
                        const Eigen::VectorXd& f_plus, const GuardTangent& residual,
                        const TangentColumns& columns, FlowJump& jump, bool& first) {
  const bool passed = passes(residual, number, t, x, f_minus, f_plus, columns);
  const double speed = residual.by_state.dot(f_minus) + residual.by_time;
  for (Index k = 0; k < columns.size(); ++k) {
    const double moved = residual.columns[k] == 0.0 ? 0.0
                         : passed                   ? -residual.columns[k] / speed
                                                    : no_time;
    if (std::isnan(moved)) jump.obstacle = only_grazes;
    if (!first && moves_apart(jump.dtau[k], moved)) jump.obstacle = two_at_once;
    const bool lost = !first && (std::isnan(moved) || moves_apart(jump.dtau[k], moved));
    if (first) jump.dtau[k] = moved;
    if (lost) jump.dtau[k] = no_time;
  }
  first = false;
}

bool FlowSwitches::is_jump(const Change& at, const StateAt& state) {
  return is_jump(flow_->rates_of_branch(at.before, state(at.before).data()),
                 flow_->rates_of_branch(at.after, state(at.after).data()));
}

FlowJump FlowSwitches::jump(const Change& at, const StateAt& state, const TangentColumns& columns) {
  const Eigen::VectorXd x_minus = state(at.before), x_plus = state(at.after);
  const Eigen::VectorXd f_minus = flow_->rates_of_branch(at.before, x_minus.data()),
                        f_plus = flow_->rates_of_branch(at.after, x_plus.data());
  FlowJump found{f_minus - f_plus, Eigen::RowVectorXd::Zero(columns.size())};
  flow_->branches_at(at.before, x_minus.data(), here_);
  flow_->branches_at(at.after, x_plus.data(), there_);
  bool first = true;
  for (Index k = 0; k < flow_->switch_count(); ++k) {
    if (nth(here_, k) == nth(there_, k)) continue;
    const GuardTangent residual = flow_->of_switch(at.before, x_minus.data(), k, columns);
    if (is_at_limit(k, at.before, x_minus.data(), residual) &&
        is_at_limit(k, at.after, x_plus.data(), residual))
      take(k, at.before, x_minus.data(), f_minus, f_plus, residual, columns, found, first);
  }
  if (!first) return found;
  found.obstacle = without_root;
  for (Index k = 0; k < columns.size(); ++k)
    if (columns.matters(k)) found.dtau[k] = no_time;
  return found;
}

std::optional<FlowJump> FlowSwitches::beside(double t, const double* x,
                                             const TangentColumns& columns) {
  flow_->renew();
  if (!any()) return {};
  const Eigen::VectorXd here = VectorView(x, machine_->plan().nx),
                        flow = flow_->rates_of_branch(t, x);
  const double least = std::max(thresholds::roundings_beside_jump * thresholds::eps * std::abs(t),
                                std::numeric_limits<double>::min());
  std::optional<FlowJump> found;
  bool first = true;
  for (Index k = 0; k < flow_->switch_count(); ++k) {
    const GuardTangent residual = flow_->of_switch(t, x, k, columns);
    if (!is_at_limit(k, t, x, residual)) continue;
    const double terms = (flow_->switches_at(t, x) + k * tape::numbers_of_switch)[2];
    const double speed = std::abs(residual.by_state.dot(flow) + residual.by_time);
    if (!(speed > 0.0)) continue;
    const double away = std::max(least, residual_rounding * terms / speed);
    const Eigen::VectorXd x_minus = here - away * flow, x_plus = here + away * flow;
    flow_->branches_at(t - away, x_minus.data(), here_);
    flow_->branches_at(t + away, x_plus.data(), there_);
    if (nth(here_, k) == nth(there_, k)) continue;
    const Eigen::VectorXd f_minus = flow_->rates_of_branch(t - away, x_minus.data()),
                          f_plus = flow_->rates_of_branch(t + away, x_plus.data());
    if (!is_jump(f_minus, f_plus)) continue;
    if (!found) found = FlowJump{f_minus - f_plus, Eigen::RowVectorXd::Zero(columns.size())};
    take(k, t - away, x_minus.data(), f_minus, f_plus, residual, columns, *found, first);
  }
  return found;
}

}  // namespace saltus
