// Executions: triggers, and what follows them.
#include "saltus/simulation/detail/executions.hpp"

#include <algorithm>
#include <utility>

#include "saltus/base/philox.hpp"
#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

Executions::Executions(Machine& machine, const SimulatorOptions& options, Transition& transition,
                       Journal& journal, Present& present)
    : machine_(&machine),
      options_(&options),
      transition_(&transition),
      journal_(&journal),
      present_(&present),
      any_(std::ranges::any_of(machine.plan().guards, &GuardGroup::queued)) {}

// --- from run to run

/// The group of guards of an execution; -1 if the scene has no such queued zero crossing.
int Executions::group_of(const PendingExecution& one) const {
  const auto found = std::ranges::find_if(plan().guards, [&](const GuardGroup& group) {
    return group.queued && group.leaf == one.leaf && group.index == one.event &&
           one.entry < group.size;
  });
  return found == plan().guards.end() ? -1 : static_cast<int>(found - plan().guards.begin());
}

std::vector<WaitingExecution> Executions::found_in(const PendingExecutions& pending) const {
  std::vector<WaitingExecution> found;
  for (const PendingExecution& one : pending.all) {
    const int group = group_of(one);
    if (group < 0) {
      throw ModelError(
          text("the context is not one of this system: an execution waits of zero "
               "crossing ",
               one.event, ", guard ", one.entry, ", of block '", plan().leaf(one.leaf).path,
               "', which has no such queued zero crossing; create the context with "
               "system.create_context()"));
    }
    found.push_back({one, group});
  }
  return found;
}

void Executions::require_fits(const Context& context) const {
  if (context.pending() != nullptr) found_in(*context.pending());
}

void Executions::begin(const Context& from) {
  if (!any_) return;
  const PendingExecutions* pending = from.pending();
  if (pending == nullptr) return queue_.clear();
  queue_.load(found_in(*pending), pending->scheduled, pending->draws);
}

PendingExecutions Executions::save() const { return any_ ? queue_.save() : PendingExecutions(); }

void Executions::open() {
  queue_.open();
  chain_ = {};
  set_off_ = false;
}

// --- triggers

void Executions::trigger(const Action& action) {
  if (!present_->changes) chain_.trigger(present_->pass);
  const int group = action.index;
  const Index entry = action.slot - plan().guard(group).slot;
  if (decide_trigger(crossing_of(group).direction, action.from) == OnTrigger::cancel)
    return cancel(group, entry, action.from);
  // Where the guard has gone back unseen, as in a context that was changed by hand.
  if (crossing_of(group).is_cancelled_on_return()) cancel(group, entry, action.from);
  schedule(group, entry, action.from);
}

void Executions::schedule(int group, Index entry, int from) {
  const ZeroCrossing& crossing = crossing_of(group);
  const GuardGroup& of = plan().guard(group);
  WaitingExecution one{.pending = {.leaf = of.leaf,
                                   .event = of.index,
                                   .entry = static_cast<int>(entry),
                                   .due = present_->t + delay_of(group, entry),
                                   .frozen = crossing.use_values_from_trigger_time.value_or(false)},
                       .group = group,
                       .chain = chain_.next()};
  const Transition::Call call{&crossing.reset_map, of.leaf, entry, present_->t, of.name};
  if (one.pending.frozen) one.pending.values = transition_->values(call);
  note(EventKind::scheduled, one, -from);
  PendingExecution scheduled = one.pending;
  scheduled.number = queue_.add(std::move(one));
  if (Tangents* tangents = transition_->tangents())
    tangents->waiting().schedule(scheduled, call, crossing.delay ? &*crossing.delay : nullptr,
                                 transition_->seen_by(of.leaf, entry));
}

double Executions::delay_of(int group, Index entry) const {
  const ZeroCrossing& crossing = crossing_of(group);
  if (!crossing.delay) return 0.0;
  const double delay =
      transition_->number(*crossing.delay, plan().guard(group).leaf, entry, present_->t);
  if (is_delay(delay) && std::isfinite(present_->t + delay)) return delay;
  throw SimulationError(
      text("t = ", present_->t, " s: the delay of '", plan().guard(group).name, "' is ", delay,
           " s; expected a finite time >= 0 s, so check the function `delay` at this state"),
      present_->t, path_of(group));
}

void Executions::cancel(int group, Index entry, int from) {
  const auto key = queue_.of_guard(group, static_cast<int>(entry));
  if (!key) return;
  if (Tangents* tangents = transition_->tangents()) tangents->waiting().cancel(key->second);
  note(EventKind::cancelled, queue_.take(*key), -from);
}

// --- executions

bool Executions::collect() {
  find_due();
  if (due_.keys.empty() || cancel_returned()) return false;
  due_.priorities.clear();
  for (const Key& key : due_.keys) due_.priorities.push_back(priority_of(queue_.waiting().at(key)));
  const std::size_t first = choose_first(due_.priorities, [this] { return draw(); });
  if (transition_->tangents() != nullptr) look_at_ties(due_.priorities[first]);
  taken_ = queue_.take(due_.keys[first]);
  if (Tangents* tangents = transition_->tangents())
    tangents->waiting().take_execution(taken_.pending.number, plan().guard(taken_.group).name);
  present_->actions.push_back({taken_.pending.leaf, Cause::execution, taken_.group, -1, 0, false});
  return true;
}

/// Tells the derivatives which executions have the priority of the one that is taken.
void Executions::look_at_ties(double priority) {
  std::vector<PriorityOf> tied;
  for (std::size_t i = 0; i < due_.keys.size(); ++i) {
    if (due_.priorities[i] != priority) continue;
    const WaitingExecution& one = queue_.waiting().at(due_.keys[i]);
    const ZeroCrossing& crossing = crossing_of(one.group);
    tied.push_back({crossing.priority ? &*crossing.priority : nullptr, one.pending.leaf,
                    one.pending.entry, plan().guard(one.group).name});
  }
  if (tied.size() > 1) transition_->tangents()->waiting().tie(tied);
}

void Executions::add_due(std::vector<DueNow>& all) {
  find_due();
  for (const Key& key : due_.keys)
    all.push_back({{WaitingKey::Queue::executions, key.second},
                   plan().guard(queue_.waiting().at(key).group).name});
}

void Executions::find_due() {
  due_.keys.clear();
  for (const auto& [key, one] : queue_.waiting()) {
    if (key.first > present_->t + Calendar::slack(present_->t)) break;
    due_.keys.push_back(key);
  }
}

/// Adds the cancellation of those that are due though their guards are back on their armed sides:
/// within the error bound of zero a guard may go back unseen. Whether there is one.
bool Executions::cancel_returned() {
  bool found = false, evaluated = false;
  for (const Key& key : due_.keys) {
    const WaitingExecution& one = queue_.waiting().at(key);
    if (!may_have_gone_back(one)) continue;
    if (!std::exchange(evaluated, true)) {
      g_.resize(present_->g.size());
      machine_->guards(present_->t, machine_->x.data(), g_.data());
    }
    const GuardGroup& group = plan().guard(one.group);
    const int slot = static_cast<int>(group.slot) + one.pending.entry;
    const int firing = firing_side(crossing_of(one.group).direction);
    if (sign_of(g_[static_cast<std::size_t>(slot)]) != -firing) continue;
    present_->actions.push_back({group.leaf, Cause::trigger, one.group, slot, firing, false});
    found = true;
  }
  return found;
}

/// A guard that its mode does not see does not go back.
bool Executions::may_have_gone_back(const WaitingExecution& one) const {
  const ZeroCrossing& crossing = crossing_of(one.group);
  if (!crossing.is_cancelled_on_return()) return false;
  return !crossing.start_mode || machine_->modes[one.pending.leaf] == *crossing.start_mode;
}

double Executions::priority_of(const WaitingExecution& one) const {
  const ZeroCrossing& crossing = crossing_of(one.group);
  if (!crossing.priority) return no_priority;
  At at = machine_->at(one.pending.leaf, present_->t, machine_->x.data());
  at.entry = one.pending.entry;
  const double priority = (*crossing.priority)(*plan().leaf(one.pending.leaf).system, at);
  if (!std::isnan(priority)) return priority;
  throw SimulationError(
      text("t = ", present_->t, " s: the priority of '", plan().guard(one.group).name,
           "' is not a number (NaN); expected a number, so check the function `priority` at this "
           "state"),
      present_->t, path_of(one.group));
}

double Executions::draw() {
  const auto number = static_cast<double>(queue_.draw());
  return detail::uniform(detail::random_words(options_->event_seed, number, 0));
}

Index Executions::execute(const Action& action) {
  const ZeroCrossing& crossing = crossing_of(action.index);
  const PendingExecution& one = taken_.pending;
  const Transition::Call call{&crossing.reset_map, one.leaf, one.entry, present_->t,
                              plan().guard(action.index).name};
  if (one.frozen) {
    if (Tangents* tangents = transition_->tangents()) tangents->waiting().write_frozen(one);
    transition_->write(one.leaf, one.values);
  }
  if (!one.frozen && crossing.reset_map) transition_->run(call);
  if (crossing.end_mode) transition_->enter_mode(one.leaf, *crossing.end_mode);
  set_off_ = set_off_ || taken_.chain > 1;
  chain_.execute(queue_.is_new(one) ? taken_.chain : 1, present_->pass);
  note(EventKind::executed, taken_, 0);
  return plan().guard(action.index).slot + one.entry;
}

void Executions::note(EventKind kind, const WaitingExecution& one, int direction) {
  journal_->note({.kind = kind,
                  .source = one.group,
                  .leaf = one.pending.leaf,
                  .direction = direction,
                  .predicted = one.pending.due,
                  .entry = one.pending.entry});
}

}  // namespace saltus
