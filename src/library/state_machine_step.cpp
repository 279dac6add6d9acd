// When a transition of a state machine is taken, and what it writes.
#include "saltus/library/detail/state_machine_step.hpp"

#include <algorithm>
#include <cmath>

namespace saltus::detail {

namespace {

/// Half of the jump of a guard over zero, in the size of what it may read: above the rounding of
/// these values. It moves no root.
double half_jump(const StateMachineValues& now) {
  constexpr double share = 1e-9, least = 1e-100;
  double size = std::abs(now.time) + now.variables.cwiseAbs().sum();
  size += now.parameters.cwiseAbs().sum();
  for (int k = 0; k < now.inputs.size(); ++k) size += std::abs(now.inputs(k));
  return share * size + least;
}

}  // namespace

StateMachineValues StateMachineLayout::values(const At& at, const double* variables) const {
  return {.time = at.time,
          .since = at.time - at.z[entered_at],
          .state = at.mode < states ? at.mode : first,
          .inputs = at.u,
          .variables = {variables, at.z.size() - first_variable},
          .parameters = at.p};
}

void StateMachineLayout::enter(int target, const std::vector<StateMachineAction>& leave,
                               const StateMachineAction& entry, const At& at, Next& next) const {
  Eigen::VectorXd z = at.z;
  const VectorRef variables(z.data() + first_variable, z.size() - first_variable);
  StateMachineValues now = values(at, variables.data());
  for (const StateMachineAction& act : leave)
    if (act) act(now, variables);
  now.since = 0.0;
  now.state = target;
  if (entry) entry(now, variables);
  z[entered_at] = at.time;
  next.set_discrete_state(z);
  next.set_mode(target);
}

double StateMachineDue::residual(const StateMachineValues& now) const {
  const double late = after ? now.since - *after : 1.0;
  return guard ? std::min(late, guard.residual(now)) : late;
}

double StateMachineStep::residual(const At& at) const {
  if (at.mode != source) return -1.0;
  const StateMachineValues now = layout.values(at);
  const auto is_due = [&now](const StateMachineDue& other) { return other.residual(now) >= 0.0; };
  if (std::any_of(before.begin(), before.end(), is_due)) return -1.0;
  const double own = due.residual(now);
  return own < 0.0 ? own - half_jump(now) : own + half_jump(now);
}

/// The time since the source was entered is 0 then; without that it is `after` within rounding. A
/// guard that has fired is not below zero but by rounding.
bool StateMachineStep::is_still_due(const StateMachineValues& now) const {
  if (due.after) return now.since >= 0.5 * *due.after;
  return due.guard.residual(now) >= -half_jump(now);
}

/// A transition of a higher priority may have left the source at the same time.
void StateMachineStep::take(const At& at, Next& next) const {
  if (at.mode != source) return;
  const StateMachineValues now = layout.values(at);
  if (trigger && due.guard && !due.guard.holds(now)) return;
  if (!trigger && behind_return && !is_still_due(now)) return;
  layout.enter(target, leave, entry, at, next);
}

ZeroCrossing StateMachineStep::crossing(const std::string& event) const {
  ZeroCrossing found{.name = event,
                     .reset_map = [step = *this](const At& at, Next& next) { step.take(at, next); },
                     .direction = Direction::negative_then_non_negative,
                     .at_start = AtStart::fire,
                     .zeno_tolerance = 0.0};
  if (trigger) {
    found.guard = [step = *this](const At& at) {
      return step.trigger.residual(step.layout.values(at));
    };
    found.start_mode = source;
    found.at_start = AtStart::ignore;
    found.yields = behind_return;
  } else {
    found.guard = [step = *this](const At& at) { return step.residual(at); };
    found.follows_updates = beside_triggers;
  }
  return found;
}

}  // namespace saltus::detail
