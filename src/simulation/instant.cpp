// The passes of an instant.
#include "saltus/simulation/detail/instant.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

void Instant::open(double t, const std::vector<int>& due, double longest) {
  present_.open(t, longest);
  transition_.open();
  journal_.open(t);
  flow_.open(t, longest);
  edges_.open();
  holds_.open();
  std::swap(present_.firings, guards_->fired_at_root);
  guards_->fired_at_root.clear();
  before_.guards = guards_->all(), before_.roots = present_.firings, before_.jump = jump_;
  for (const Firing& root : present_.firings) {
    const auto k = static_cast<std::size_t>(root.slot);
    GuardNow& now = present_.now[k];
    const bool jumped = root.jump > 0.0 && root.jump > crossings_.uncertainty(k);  // else: rounding
    now.location = location_error(guards_->g[k], jumped);
    if (root.at_zero && !jumped) now.flight = t - (*guards_)[k].armed_at;
  }
  flow_.forget();  // it belongs to x-
  for (const int event : due)
    present_.actions.push_back({plan().scheduled(event).leaf, Cause::time, event, -1, 0, false});
}

Outcome Instant::run(double t, const std::vector<int>& due, double longest, bool at_start) {
  open(t, due, longest);
  bool armed = !at_start;
  turn_beside_root();
  for (;; ++present_.pass) {
    if (present_.pass >= options_->max_passes) {
      if (transition_.pass_wrote()) journal_.throw_no_end();
      present_.outcome.chatters = true;  // only relations or modes change, without end
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

/// A guard may be at zero within the resolution of the root of another one. The flow decides its
/// side; a guard that the flow takes to its firing side has not crossed yet.
void Instant::turn_beside_root() {
  for (const std::size_t k : guards_->beside_root) {
    const Guard& guard = (*guards_)[k];
    if (guard.phase != Phase::armed || !plan().guard(guard.group).is_crossing()) continue;
    const int side =
        flow_.side(plan().guard(guard.group), static_cast<Index>(k), std::abs(guards_->g[k]), 0)
            .side;
    if (side == -firing_side(guard.direction)) guards_->turn(k, side);
  }
  guards_->beside_root.clear();
  flow_.forget();
}

/// Collects the actions of the next pass. False if there is nothing to do.
bool Instant::collect() {
  journal_.at_jump(jump_ + 1);
  const bool let_go = take_contacts();
  const bool flipped = flip_relations();
  rows_.before(jump_, flipped);
  machine_->evaluate_instant(present_.t);
  const bool released = collect_edges() || let_go;
  collect_crossings();
  present_.changes =
      flipped || released || (present_.pass == 0 && transition_.held_outputs_changed()) ||
      std::ranges::any_of(present_.actions, [this](const Action& action) { return acts(action); });
  if (!present_.changes) journal_.at_jump(jump_);
  note_passive();
  return present_.changes || !present_.actions.empty();
}

/// Whether an action counts as a change. A guard that only ends the run does not. A time event does:
/// whether held signals follow it must not depend on which of them are recorded.
bool Instant::acts(const Action& action) const {
  return action.cause != Cause::crossing ||
         plan().crossing_of(plan().guard(action.index)).has_effect();
}

void Instant::run_pass() {
  transition_.begin_pass();
  for (const Action& action : present_.actions) run_action(action);
  present_.actions.clear();
  commit();
  relations_.read_again();
  find_next();
  if (present_.changes) rows_.after(++jump_);
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
    transition_.run({&event.update, action.leaf, 0, present_.t, journal_.name_of(source)});
  journal_.note({.kind = EventKind::time, .source = source, .leaf = action.leaf});
}

/// The effect that the author of a zero crossing or an edge declared.
Instant::Effect Instant::effect_of(const Action& action) {
  const auto index = static_cast<std::size_t>(action.index);
  if (action.cause == Cause::edge)
    return {&edges_.reset_of(index).reset_map, nullptr, &holds_.of_edge(index)};
  const ZeroCrossing& crossing = plan().crossing_of(plan().guards[index]);
  return {&crossing.reset_map, crossing.end_mode ? &*crossing.end_mode : nullptr,
          &holds_.of_guard(static_cast<std::size_t>(action.slot))};
}

/// Runs an effect. Returns whether it wrote a state or a mode.
bool Instant::run_effect(const Effect& effect, int leaf, const std::string& source) {
  const bool wrote =
      *effect.map && transition_.run({effect.map, leaf, effect.hold->entry, present_.t, source});
  if (effect.end_mode) transition_.enter_mode(leaf, *effect.end_mode);
  return wrote || effect.end_mode != nullptr;
}

/// Runs the effect of a zero crossing or an edge.
void Instant::run_reset(const Action& action) {
  const int source = journal_.source_of(action.cause, action.index);
  const auto index = static_cast<std::size_t>(action.index);
  const Effect effect = effect_of(action);
  Holds::Hold& hold = *effect.hold;
  if (effect.any() && !action.carry) holds_.fired(hold, present_.t);
  const bool wrote = run_effect(effect, action.leaf, journal_.name_of(source));
  const bool last = action.cause == Cause::crossing && journal_.ends_run(index);
  present_.outcome.terminal = present_.outcome.terminal || last;
  journal_.note(
      {.kind = last ? EventKind::terminal : EventKind::zero_crossing,
       .source = source,
       .leaf = action.leaf,
       .direction = -action.from,
       .entry = action.slot < 0 ? 0 : (*guards_)[static_cast<std::size_t>(action.slot)].entry});
  if (!wrote || action.carry) return;
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
    } else if (!guard.monitor && guard.crossed(g)) {
      // Its side does not change: the flow decides when integration continues (3.4).
      if (present_.now[k].put_at_zero = crossings_.is_at_zero(k); !present_.now[k].put_at_zero)
        present_.fire(k, guard.side);
    } else {
      guards_->see(k, g);
    }
  }
}

/// Arms all active guards for the solver. A guard at zero, or a guard that just fired, gets its
/// side from the flow.
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
