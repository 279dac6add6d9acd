// The passes of an instant.
#include "saltus/simulation/detail/instant.hpp"

#include <algorithm>

namespace saltus {

void Instant::open(double t, const std::vector<int>& due, double longest) {
  present_.open(t, longest);
  transition_.open();
  journal_.open(t);
  flow_.open(t, longest);
  edges_.open();
  std::swap(present_.firings, guards_->fired_at_root);
  guards_->fired_at_root.clear();
  for (const Firing& root : present_.firings) {
    const auto k = static_cast<std::size_t>(root.slot);
    present_.now[k].g_minus = guards_->g[k];
    if (root.at_zero) present_.now[k].flight = t - (*guards_)[k].armed_at;
  }
  for (const int event : due)
    present_.actions.push_back({plan().scheduled(event).leaf, Cause::time, event, -1, 0, false});
}

Outcome Instant::run(double t, const std::vector<int>& due, double longest, bool at_start) {
  open(t, due, longest);
  bool armed = !at_start;
  for (;; ++present_.pass) {
    if (present_.pass >= options_->max_passes) {
      if (transition_.pass_wrote()) journal_.throw_no_end();
      present_.outcome.chatters = true;  // relations or modes only: both sides lead to the surface
      break;
    }
    if (collect()) {
      run_pass();
      armed = false;
      continue;
    }
    if (armed) break;
    journal_.at_jump(jump_);
    arm(at_start);
    armed = true;
    if (present_.firings.empty() && present_.actions.empty()) break;
  }
  present_.outcome.restart = present_.outcome.restart || transition_.restarts();
  present_.outcome.events = journal_.events();
  return present_.outcome;
}

/// Gathers what the next pass does; false if there is nothing to do.
bool Instant::collect() {
  journal_.at_jump(jump_ + 1);
  const bool let_go = take_contacts();
  const bool flipped = flip_relations();
  machine_->evaluate_instant(present_.t);
  const bool released = collect_edges() || let_go;
  collect_crossings();
  return flipped || released || !present_.actions.empty() ||
         (present_.pass == 0 && transition_.held_outputs_changed());
}

/// Takes out of the firings those of contacts, and those against the flow; true if a contact let
/// go.
bool Instant::take_contacts() {
  bool let_go = false;
  std::erase_if(present_.firings, [&](const Firing& firing) {
    const ContactGuards::Taken taken = contacts_.take(firing);
    let_go = let_go || taken == ContactGuards::Taken::let_go;
    if (taken != ContactGuards::Taken::no) return true;
    return present_.pass == 0 && crossings_.goes_against(firing);
  });
  return let_go;
}

bool Instant::flip_relations() {
  bool flipped = false;
  for (GuardNow& now : present_.now) now.fired_in_pass = false;
  for (const Firing& firing : present_.firings) {
    const auto k = static_cast<std::size_t>(firing.slot);
    present_.now[k].fired = present_.now[k].fired_in_pass = true;
    guards_->fired(k, firing.from);
    if (plan().guard((*guards_)[k].group).is_crossing()) continue;
    relations_.flip(firing);
    flipped = true;
  }
  return flipped;
}

/// The edges of watched signals; true if a falling one ended a hold.
bool Instant::collect_edges() {
  bool released = false;
  for (std::size_t e = 0; e < plan().edges.size(); ++e) {
    const Edges::Look look = edges_.look(e);
    Holds::Hold& hold = holds_.of_edge(e);
    if (hold.monitor.holding && !look.now) {
      holds_.release(hold);
      released = true;
    } else if (hold.monitor.holding) {
      collect_carried(e);
    } else if (look.fires) {
      present_.actions.push_back(
          {plan().edges[e].leaf, Cause::edge, static_cast<int>(e), -1, look.now ? -1 : 1, false});
      edges_.fired(e);
    }
  }
  return released;
}

/// A leaf on hold whose reset value moved while its trigger stayed: a floor that rises carries the
/// ball. Not before the relations have been read again, for a floor that falls moves the reset
/// value too.
void Instant::collect_carried(std::size_t e) {
  if (present_.pass == 0 || edges_.is_carried(e)) return;
  const EdgeWatch& edge = plan().edges[e];
  const bool moved = std::ranges::any_of(edge.reads, [&](int input) {
    const Node& node = plan().node(input);
    return input != edge.node && node.rate == Rate::held && transition_.changed(node.place);
  });
  if (!moved) return;
  present_.actions.push_back({edge.leaf, Cause::edge, static_cast<int>(e), -1, -1, true});
  edges_.carried(e);
}

/// The zero crossings that fire in this pass; leaf by leaf, in declaration order.
void Instant::collect_crossings() {
  for (const Firing& firing : present_.firings) {
    const auto k = static_cast<std::size_t>(firing.slot);
    const Guard& guard = (*guards_)[k];
    const GuardGroup& group = plan().guard(guard.group);
    if (!group.is_crossing()) continue;
    const bool acts = plan().crossing_of(group).has_effect() ||
                      journal_.ends_run(static_cast<std::size_t>(guard.group));
    if (acts) {
      present_.actions.push_back({group.leaf, Cause::crossing, guard.group, firing.slot,
                                  firing.from, holds_.of_guard(k).monitor.holding});
    } else {  // a monitor, or terminal only later
      journal_.note({.kind = EventKind::zero_crossing,
                     .source = guard.group,
                     .leaf = group.leaf,
                     .direction = -firing.from,
                     .entry = guard.entry});
    }
  }
  present_.firings.clear();
  sort_actions();
}

/// Within a leaf updates come first: they read x- z-, and what they write is not lost to a reset.
/// The order is stable, and the sort allocates nothing.
void Instant::sort_actions() {
  const auto rank = [](Cause cause) { return cause == Cause::time ? -1 : static_cast<int>(cause); };
  const auto before = [&](const Action& a, const Action& b) {
    return a.leaf != b.leaf ? a.leaf < b.leaf : rank(a.cause) < rank(b.cause);
  };
  auto& actions = present_.actions;
  if (actions.size() < 2) return;
  for (auto a = actions.begin(); a != actions.end(); ++a)
    std::rotate(std::upper_bound(actions.begin(), a, *a, before), a, a + 1);
}

void Instant::run_pass() {
  transition_.begin_pass();
  for (const Action& action : present_.actions) run_action(action);
  present_.actions.clear();
  commit();
  relations_.read_again();
  find_next();
  ++jump_;
  if (recorder_ != nullptr) recorder_->record(present_.t, jump_, machine_->x.data());
}

void Instant::run_action(const Action& action) {
  if (action.cause == Cause::zeno) return transition_.enter_mode(action.leaf, action.from);
  journal_.cause(journal_.source_of(action.cause, action.index));
  action.cause == Cause::time ? run_update(action) : run_reset(action);
}

void Instant::run_update(const Action& action) {
  const int source = journal_.source_of(action.cause, action.index);
  const TimeEvent& event = plan().time_event_of(plan().scheduled(action.index));
  if (event.update)
    transition_.run({&event.update, action.leaf, 0, true, present_.t, journal_.name_of(source)});
  journal_.note({.kind = EventKind::time, .source = source, .leaf = action.leaf});
}

/// A zero crossing, or an edge.
void Instant::run_reset(const Action& action) {
  const int source = journal_.source_of(action.cause, action.index);
  const auto index = static_cast<std::size_t>(action.index);
  const ZeroCrossing* crossing =
      action.cause == Cause::crossing ? &plan().crossing_of(plan().guards[index]) : nullptr;
  const ResetMap& map = crossing ? crossing->reset_map : edges_.reset_of(index).reset_map;
  Holds::Hold& hold =
      crossing ? holds_.of_guard(static_cast<std::size_t>(action.slot)) : holds_.of_edge(index);
  const bool ends = crossing && crossing->end_mode;
  if ((map || ends) && !action.carry) hold.monitor.fired(present_.t);
  const bool wrote = map && transition_.run({&map, action.leaf, hold.entry, false, present_.t,
                                             journal_.name_of(source)});
  if (ends) transition_.enter_mode(action.leaf, *crossing->end_mode);
  const bool last = crossing && journal_.ends_run(index);
  present_.outcome.terminal = present_.outcome.terminal || last;
  journal_.note({.kind = last ? EventKind::terminal : EventKind::zero_crossing,
                 .source = source,
                 .leaf = action.leaf,
                 .direction = -action.from,
                 .entry = hold.entry});
  if (!(wrote || ends) || action.carry) return;
  if (holds_.look_for_accumulation(hold) && action.cause == Cause::edge)
    contacts_.keep_relations_of(plan().edges[index]);
}

void Instant::commit() {
  if (holds_.any()) contacts_.release_kicked();
  const bool entered = transition_.commit();
  if (entered) select_guards();
  if (entered && holds_.any()) contacts_.release_unseen();
  flow_.forget();
}

/// Zero crossings that the commit moved across zero in their direction fire in the next pass.
void Instant::find_next() {
  for (const std::size_t k : guards_->active()) {
    const Guard& guard = (*guards_)[k];
    const double g = present_.g[k];
    if (!plan().guard(guard.group).is_crossing()) continue;
    if (holds_.of_guard(k).monitor.holding) {
      if (!present_.now[k].fired_in_pass) contacts_.look_at_held(k);  // else it just came to rest
    } else if (present_.now[k].fired_in_pass) {
      guards_->turn(k, sign_of(g));
      guards_->set_base(k, g);
    } else if (!guard.monitor && guards_->crossed(k, g)) {
      present_.fire(k, guard.side);
    } else {
      guards_->see(k, g);
    }
  }
}

/// Sides for the solver. A guard at zero, or one that just fired, takes the side the flow takes it
/// to.
void Instant::arm(bool at_start) {
  for (const std::size_t k : guards_->active()) {
    const Guard& guard = (*guards_)[k];
    guards_->g[k] = present_.g[k];
    guards_->set_base(k, present_.g[k]);
    if (!plan().guard(guard.group).is_crossing())
      relations_.arm(k);
    else if (holds_.of_guard(k).monitor.holding)
      contacts_.arm_crossing(k);
    else
      crossings_.arm(k, at_start);
    guards_->mark_armed_at(k, present_.now[k].fired && guard.at_zero() ? present_.t : not_armed);
  }
}

}  // namespace saltus
