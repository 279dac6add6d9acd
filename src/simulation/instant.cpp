// The passes of an instant.
#include "saltus/simulation/detail/instant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

void Instant::open(double t, const std::vector<int>& due, double longest) {
  present_.open(t, longest);
  if (plan().reads_before) machine_->evaluate_moving(t, machine_->x.data());
  transition_.open();
  journal_.open(t);
  flow_.open(t, longest);
  edges_.open();
  holds_.open();
  open_queues();
  std::swap(present_.firings, guards_->fired_at_root);
  guards_->fired_at_root.clear();
  before_.guards = guards_->all(), before_.roots = present_.firings, before_.jump = jump_;
  for (const Firing& root : present_.firings) {
    const std::size_t k = root.guard();
    GuardNow& now = present_.note(k);
    if (root.jump > 0.0 && root.jump > crossings_.uncertainty(k)) now.jump = root.jump;
    now.location = location_error(guards_->g[k], now.jumped());
    now.before = guards_->base_before_root(k);
    if (root.at_zero && !now.jumped()) now.flight = t - (*guards_)[k].armed_at;
  }
  flow_.forget();  // it belongs to x-
  for (const int event : due)
    present_.actions.push_back({plan().scheduled(event).leaf, Cause::time, event, -1, 0, false});
  if (Tangents* tangents = transition_.tangents()) tangents->open(present_, due, waiting_due());
}

Outcome Instant::run(double t, const std::vector<int>& due, double longest, bool at_start) {
  open(t, due, longest);
  bool armed = !at_start;
  turn_beside_root();
  for (;; ++present_.pass) {
    if (present_.pass - executions_.beside() >= options_->max_passes) {
      if (transition_.pass_wrote() || executions_.executed() || deliveries_.delivered())
        journal_.throw_no_end();
      present_.outcome.chatters = true;  // only relations or modes change, without end
      break;
    }
    if (collect()) {
      run_pass();
      armed = false;
      continue;
    }
    if (armed && !std::exchange(present_.contact_changed, false)) break;
    journal_.at_jump(jump_);
    arm(at_start);
    armed = true;
    if (present_.firings.empty() && present_.actions.empty()) break;
  }
  find_next_due();
  present_.outcome.restart = present_.outcome.restart || transition_.restarts();
  present_.outcome.events = journal_.events();
  if (Tangents* tangents = transition_.tangents()) tangents->close();
  return present_.outcome;
}

/// A guard may be at zero within the resolution of the root of another one. The flow decides its
/// side; a guard that the flow takes to its firing side has not crossed yet.
void Instant::turn_beside_root() {
  for (const std::size_t k : guards_->beside_root) {
    const Guard& guard = (*guards_)[k];
    const GuardGroup& group = plan().guard(guard.group);
    if (!group.is_crossing()) continue;
    const auto flow_to = [&] {
      return flow_.side(group, static_cast<Index>(k), std::abs(guards_->g[k]), 0).side;
    };
    if (!crossed_beside_root(guard.direction, guard.phase, flow_to)) continue;
    guards_->turn(k, -firing_side(guard.direction));
    present_.note(k).turned_beside_root = true;
  }
  guards_->beside_root.clear();
  flow_.forget();
}

/// Collects the actions of the next pass. False if there is nothing to do.
bool Instant::collect() {
  journal_.at_jump(jump_ + 1);
  const bool let_go = collector_.take_contacts();
  const bool flipped = collector_.flip_relations();
  rows_.before(jump_, flipped);
  machine_->evaluate_instant(present_.t);
  follow_controls();
  judge_jumps(flipped);
  if (Tangents* tangents = transition_.tangents()) {
    tangents->look_at_firings(present_);
    tangents->evaluated();
  }
  const bool released = collector_.collect_edges() || let_go;
  collector_.collect_crossings();
  present_.changes = flipped || released ||
                     (present_.pass == 0 && transition_.held_outputs_changed()) ||
                     collector_.acts();
  if (deliveries_.any() && deliveries_.collect()) present_.changes = true;
  if (executions_.any() && !present_.changes && present_.actions.empty())
    present_.changes = executions_.collect();
  if (!present_.changes) journal_.at_jump(jump_);
  collector_.note_passive();
  return present_.changes || !present_.actions.empty();
}

/// Looks again at the guards that jumped at the root, where the relations of the root had not flipped yet.
void Instant::judge_jumps(bool flipped) {
  if (present_.pass > 0) return;
  const auto judged = [this](const MonitorHit& hit) {
    return judges(hit, present_.t, before_.roots);
  };
  const bool monitors = std::ranges::any_of(guards_->monitors, judged);
  if (flipped && (monitors || collector_.some_jumped())) {
    machine_->guards_at(present_.t, machine_->x.data(), present_.g.data());
    collector_.take_back_jumps();
  }
  if (monitors) log_judged_monitors(flipped);
}

void Instant::log_judged_monitors(bool flipped) {
  for (const MonitorHit& hit : guards_->monitors) {
    if (!judges(hit, present_.t, before_.roots)) continue;
    if (const std::size_t k = hit.firing.guard();
        flipped && came_back(hit.firing.from, present_.g[k])) {
      guards_->see(k, present_.g[k]);
      continue;
    }
    log_monitor(hit, machine_->x.data());
    if (Tangents* tangents = transition_.tangents()) tangents->monitor(hit, machine_->x.data());
  }
}

void Instant::run_pass() {
  transition_.begin_pass();
  for (const Action& action : present_.actions) effects_.run(action);
  present_.actions.clear();
  if (deliveries_.any()) deliveries_.run();
  commit();
  do relations_.read_again();
  while (follow_controls());
  find_next();
  if (present_.changes) rows_.after(++jump_);
}

void Instant::commit() {
  if (holds_.any()) contacts_.release_kicked();
  const bool entered = transition_.commit();
  if (entered) select_guards();
  if (entered && holds_.any()) contacts_.release_unseen(ContactGuards::Unseen::by_mode);
  flow_.forget();
}

/// Chooses the guards anew if a control signal has changed; returns whether one has. A guard that is
/// seen again is armed like a guard whose mode is entered.
bool Instant::follow_controls() {
  if (!machine_->seen_guards().outdated()) return false;
  select_guards();
  if (holds_.any()) contacts_.release_unseen(ContactGuards::Unseen::by_control);
  return true;
}

/// Zero crossings that the commit moved across zero in their direction fire in the next pass.
void Instant::find_next() {
  for (const std::size_t k : guards_->active().crossings()) {
    if (is_untouched(k)) {
      guards_->stay(k, present_.g[k]);
      continue;
    }
    const GuardGroup& group = plan().guard((*guards_)[k].group);
    const bool holds = holds_.of_guard(k).monitor.holding;
    switch (decide_after_pass(holds, present_.now(k).fired_in_pass, group.queued)) {
      case AfterPass::nothing:
        break;
      case AfterPass::look_at_hold:
        contacts_.look_at_held(k);
        break;
      case AfterPass::see:
        guards_->turn(k, side_after_firing(present_.g[k], present_.now(k).location));
        guards_->set_base(k, present_.g[k]);
        break;
      case AfterPass::see_behind:
        guards_->turn(k, -(*guards_)[k].came_from);
        guards_->set_base(k, present_.g[k]);
        [[fallthrough]];  // a reset map may have carried the trigger back
      case AfterPass::look:
        look_at_crossing(k);
    }
  }
}

/// Whether the commit moved a guard, which was at zero beside the root of another one, off zero.
bool Instant::left_zero_beside_root(std::size_t k) {
  return moves_off_zero(guards_->g[k], present_.g[k], crossings_.uncertainty(k));
}

/// Arms a guard that was at zero beside the root of another one, and is there still.
void Instant::continue_beside_root(std::size_t k) {
  if (left_zero_beside_root(k)) return;
  const Guard& guard = (*guards_)[k];
  const Departure::Side flow =
      flow_.side(plan().guard(guard.group), static_cast<Index>(k), std::abs(present_.g[k]), 0);
  const int side = side_beside_root(guard.direction, flow.side);
  if (side != guard.side) guards_->wait(k, side, flow.rounding);
}

/// Whether a guard that fired in an earlier pass is where its root was, within its error.
bool Instant::stays_at_root(std::size_t k) const {
  const GuardNow& now = present_.now(k);
  return now.fired && side_after_firing(present_.g[k], now.location) == 0;
}

void Instant::look_at_crossing(std::size_t k) {
  const Guard& guard = (*guards_)[k];
  const double g = present_.g[k];
  if (!guard.crossed(g)) return stays_at_root(k) ? guards_->turn(k, 0) : guards_->see(k, g);
  if (present_.now(k).turned_beside_root && !left_zero_beside_root(k)) {
    guards_->turn(k, firing_side(guard.direction));
    return guards_->see(k, g);
  }
  // Its side does not change: the flow decides when integration continues (3.4).
  if (present_.note(k).put_at_zero = crossings_.is_at_zero(k); !present_.now(k).put_at_zero)
    present_.fire(k, guard.side);
}

/// Notes when a guard fired. That is kept through other instants until the flow has taken the guard clearly off
/// zero: the firing of another block says nothing about its side.
void Instant::mark_armed_at(std::size_t k) {
  const GuardNow& now = present_.now(k);
  const Guard& guard = (*guards_)[k];
  if (now.fired)
    guards_->mark_armed_at(k, guard.at_zero() ? present_.t : not_armed,
                           present_.t + now.clear_after);
  else
    forget_firing(k);
}

/// Forgets the last firing of a guard that the flow has taken clearly off zero since.
void Instant::forget_firing(std::size_t k) {
  if (!(present_.t < (*guards_)[k].clear_at)) guards_->mark_armed_at(k, not_armed, not_armed);
}

/// Arms all active guards for the solver. A guard at zero, or a guard that just fired, gets its
/// side from the flow.
void Instant::arm(bool at_start) {
  guards_->see_reads(present_.g);
  for (const std::size_t k : guards_->active().crossings()) {
    const bool goes_on = !at_start && is_untouched(k);
    if (!goes_on && present_.now(k).turned_beside_root) continue_beside_root(k);
    guards_->stay(k, present_.g[k]);
    if (goes_on) {
      forget_firing(k);
      continue;
    }
    if (holds_.of_guard(k).monitor.holding)
      contacts_.arm_crossing(k);
    else
      crossings_.arm(k, at_start);
    mark_armed_at(k);
  }
  for (const std::size_t k : guards_->active().relations()) {
    guards_->stay(k, present_.g[k]);
    relations_.arm(k);
    mark_armed_at(k);
  }
}

}  // namespace saltus
