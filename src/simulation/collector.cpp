// Collector: firings, edges, zero crossings.
#include <algorithm>
#include <iterator>

#include "saltus/simulation/detail/collector.hpp"

namespace saltus {

namespace {

/// The place of an action among those of its leaf. Updates come first: they read x- z-, and a reset
/// map that follows sees their results. Before them a part that is enabled returns to its start.
int rank(const Plan& plan, const Action& action) {
  switch (action.cause) {
    case Cause::edge:
      return plan.reset_of(plan.edge(action.index)).before_updates ? -2
                                                                   : static_cast<int>(Cause::edge);
    case Cause::time:
      return -1;
    case Cause::trigger:
      return static_cast<int>(Cause::crossing);  // by declaration
    default:
      return static_cast<int>(action.cause);
  }
}

/// Sorts actions by leaf. The order is stable, and the sort allocates nothing.
void sort(const Plan& plan, std::vector<Action>& actions) {
  const auto before = [&](const Action& a, const Action& b) {
    return a.leaf != b.leaf ? a.leaf < b.leaf : rank(plan, a) < rank(plan, b);
  };
  if (actions.size() < 2) return;
  for (auto a = actions.begin(); a != actions.end(); ++a)
    std::rotate(std::upper_bound(actions.begin(), a, *a, before), a, a + 1);
}

/// Moves the firings that wait to another list.
template <class Waits>
void let_wait(std::vector<Firing>& firings, std::vector<Firing>& waiting, const Waits& waits) {
  waiting.clear();
  std::ranges::copy_if(firings, std::back_inserter(waiting), waits);
  if (!waiting.empty()) std::erase_if(firings, waits);
}

/// Adds those that waited, so that the order of declaration decides.
void take_waiting(std::vector<Firing>& firings, std::vector<Firing>& waiting) {
  if (waiting.empty()) return;
  firings.insert(firings.end(), waiting.begin(), waiting.end());
  std::ranges::sort(firings, {}, &Firing::slot);
  waiting.clear();
}

}  // namespace

bool Collector::take_contacts() {
  if (present_->firings.empty()) return false;
  bool let_go = false;
  std::erase_if(present_->firings, [&](const Firing& firing) {
    const ContactGuards::Taken taken = contacts_->take(firing);
    let_go = let_go || taken == ContactGuards::Taken::let_go;
    if (taken != ContactGuards::Taken::no) return true;
    return present_->pass == 0 &&
           (crossings_->goes_against(firing) || relations_->turns_back(firing));
  });
  return let_go;
}

bool Collector::is_crossing(const Firing& firing) const {
  return plan_->guard((*guards_)[firing.guard()].group).is_crossing();
}

bool Collector::has_jumped(const Firing& firing) const {
  return is_crossing(firing) && present_->now(firing.guard()).jumped();
}

bool Collector::flip_relations() {
  bool flipped = false;
  present_->open_pass();
  for (const Firing& firing : present_->firings) {
    const std::size_t k = firing.guard();
    present_->fires_in_pass(k);
    guards_->fired(k, firing.from);
    if (is_crossing(firing)) continue;
    relations_->flip(firing);
    flipped = true;
  }
  return flipped;
}

bool Collector::some_jumped() const {
  return std::ranges::any_of(present_->firings,
                             [this](const Firing& firing) { return has_jumped(firing); });
}

void Collector::take_back_jumps() {
  std::erase_if(present_->firings, [this](const Firing& firing) {
    const std::size_t k = firing.guard();
    if (!has_jumped(firing) || !came_back(firing.from, present_->g[k])) return false;
    guards_->turn(k, firing.from);
    present_->take_back(k);
    return true;
  });
}

bool Collector::collect_edges() {
  bool released = false;
  for (const std::size_t e : scope_->edges) {
    const Edges::Look look = edges_->look(e);
    Holds::Hold& hold = holds_->of_edge(e);
    if (hold.monitor.holding && !look.now) {
      holds_->release(hold);
      released = true;
    } else if (hold.monitor.holding) {
      collect_carried(e);
    } else if (look.fires) {
      present_->actions.push_back(
          {plan_->edges[e].leaf, Cause::edge, static_cast<int>(e), -1, look.now ? -1 : 1, false});
      edges_->fired(e);
    }
  }
  return released;
}

/// Applies the reset map again to a leaf on hold whose reset value changed while its trigger did
/// not: a rising floor carries the ball. This waits until the relations have been read again,
/// because a falling floor changes the reset value too.
void Collector::collect_carried(std::size_t e) {
  if (present_->pass == 0 || edges_->is_carried(e)) return;
  const EdgeWatch& edge = plan_->edges[e];
  const bool moved = std::ranges::any_of(edge.reads, [&](int input) {
    const Node& node = plan_->node(input);
    return input != edge.node && node.rate == Rate::held && transition_->changed(node.place);
  });
  if (!moved) return;
  present_->actions.push_back({edge.leaf, Cause::edge, static_cast<int>(e), -1, -1, true});
  edges_->carried(e);
}

/// Collects the zero crossings that act in this pass, by leaf, in declaration order. The list keeps
/// guards that do nothing when they fire: monitors, and terminal guards that end the run at a later
/// firing. A guard from which event wires start acts.
void Collector::collect_crossings() {
  if (present_->pass == 0)
    let_wait(present_->firings, waiting_, [this](const Firing& firing) {
      return waits_for_updates(plan_->guard((*guards_)[firing.guard()].group));
    });
  else
    take_waiting(present_->firings, waiting_);
  auto passive = present_->firings.begin();
  for (const Firing& firing : present_->firings) {
    const std::size_t k = firing.guard();
    const int number = (*guards_)[k].group;
    const GuardGroup& group = plan_->guard(number);
    if (!group.is_crossing()) continue;
    const auto same = [&](const Firing& other) { return (*guards_)[other.slot].group == number; };
    const auto waiting = std::count_if(present_->firings.begin(), passive, same);
    if (group.queued) {
      present_->actions.push_back(
          {group.leaf, Cause::trigger, number, firing.slot, firing.from, false});
    } else if (plan_->crossing_of(group).has_effect() || group.sends ||
               journal_->ends_run(number, waiting)) {
      present_->actions.push_back({group.leaf, Cause::crossing, number, firing.slot, firing.from,
                                   holds_->of_guard(k).monitor.holding});
    } else {
      *passive++ = firing;
    }
  }
  present_->firings.erase(passive, present_->firings.end());
  sort(*plan_, present_->actions);
}

bool Collector::waits_for_updates(const GuardGroup& group) const {
  if (!group.is_crossing() || !plan_->crossing_of(group).follows_updates) return false;
  return std::ranges::any_of(present_->actions,
                             [](const Action& action) { return action.cause == Cause::time; });
}

void Collector::note_passive() {
  for (const Firing& firing : present_->firings) {
    const Guard& guard = (*guards_)[firing.slot];
    journal_->note({.kind = EventKind::zero_crossing,
                    .source = guard.group,
                    .leaf = plan_->guard(guard.group).leaf,
                    .direction = -firing.from,
                    .entry = guard.entry});
  }
  present_->firings.clear();
}

bool Collector::acts() const {
  return std::ranges::any_of(present_->actions,
                             [this](const Action& action) { return acts(action); });
}

/// A guard that only ends the run does not count, and neither does a trigger, which writes nothing. A time event does: whether held signals follow it
/// must not depend on which of them are recorded.
bool Collector::acts(const Action& action) const {
  return action.cause != Cause::trigger &&
         (action.cause != Cause::crossing ||
          plan_->crossing_of(plan_->guard(action.index)).has_effect());
}

}  // namespace saltus
