// The active guards, from pass to pass.
#include "saltus/simulation/detail/guard_sides.hpp"

#include <cmath>

namespace saltus {

void GuardSides::select() {
  machine_->select_guards();
  guards_->select(machine_->seen_guards().groups(), plan());
  for (const std::size_t k : guards_->active().all)
    if (!(*guards_)[k].was_active) present_->enters(k);
}

bool GuardSides::follow_controls() {
  if (!machine_->seen_guards().outdated()) return false;
  select();
  if (holds_->any()) contacts_->release_unseen(ContactGuards::Unseen::by_control);
  return true;
}

void GuardSides::see_first() {
  for (const std::size_t k : scope_->crossings) guards_->see(k, present_->g[k]);
  for (const std::size_t k : scope_->relations) guards_->g[k] = present_->g[k];
}

void GuardSides::turn_beside_root() {
  for (const std::size_t k : guards_->beside_root) {
    const Guard& guard = (*guards_)[k];
    const GuardGroup& group = plan().guard(guard.group);
    if (!group.is_crossing()) continue;
    const auto flow_to = [&] {
      return flow_->side(group, static_cast<Index>(k), std::abs(guards_->g[k]), 0).side;
    };
    if (!crossed_beside_root(guard.direction, guard.phase, flow_to)) continue;
    guards_->turn(k, -firing_side(guard.direction));
    present_->note(k).turned_beside_root = true;
  }
  guards_->beside_root.clear();
  flow_->forget();
}

void GuardSides::find_next() {
  for (const std::size_t k : guards_->active().crossings()) {
    const double g = present_->g[k];
    if (is_untouched(k)) {
      guards_->stay(k, g);
      continue;
    }
    const GuardGroup& group = plan().guard((*guards_)[k].group);
    const bool holds = holds_->of_guard(k).monitor.holding;
    switch (decide_after_pass(holds, present_->now(k).fired_in_pass, group.queued)) {
      case AfterPass::nothing:
        break;
      case AfterPass::look_at_hold:
        contacts_->look_at_held(k);
        break;
      case AfterPass::see:
        guards_->turn(k, side_after_firing(g, present_->now(k).location));
        guards_->set_base(k, g);
        break;
      case AfterPass::see_behind:
        guards_->turn(k, -(*guards_)[k].came_from);
        guards_->set_base(k, g);
        [[fallthrough]];  // a reset map may have carried the trigger back
      case AfterPass::look:
        look_at_crossing(k);
    }
  }
}

/// Whether a guard that fired in an earlier pass is where its root was, within its error.
bool GuardSides::stays_at_root(std::size_t k) const {
  const GuardNow& now = present_->now(k);
  return now.fired && side_after_firing(present_->g[k], now.location) == 0;
}

void GuardSides::look_at_crossing(std::size_t k) {
  const Guard& guard = (*guards_)[k];
  const double g = present_->g[k];
  if (!guard.crossed(g)) return stays_at_root(k) ? guards_->turn(k, 0) : guards_->see(k, g);
  if (present_->now(k).turned_beside_root && !left_zero_beside_root(k)) {
    guards_->turn(k, firing_side(guard.direction));
    return guards_->see(k, g);
  }
  if (waits_at_zero(k)) return guards_->wait(k, guard.side, std::abs(g));
  // Its side does not change: the flow decides when integration continues (3.4).
  if (present_->note(k).put_at_zero = crossings_->is_at_zero(k); !present_->now(k).put_at_zero)
    present_->fire(k, guard.side);
}

/// Whether a guard that waits at zero is there still: the commit moved it by less than its uncertainty.
bool GuardSides::waits_at_zero(std::size_t k) {
  return (*guards_)[k].phase == Phase::waiting &&
         std::abs(present_->g[k]) <= crossings_->uncertainty(k);
}

/// Whether the commit moved a guard, which was at zero beside the root of another one, off zero.
bool GuardSides::left_zero_beside_root(std::size_t k) {
  return moves_off_zero(guards_->g[k], present_->g[k], crossings_->uncertainty(k));
}

/// Arms a guard that was at zero beside the root of another one, and is there still.
void GuardSides::continue_beside_root(std::size_t k) {
  if (left_zero_beside_root(k)) return;
  const Guard& guard = (*guards_)[k];
  const Departure::Side flow =
      flow_->side(plan().guard(guard.group), static_cast<Index>(k), std::abs(present_->g[k]), 0);
  const int side = side_beside_root(guard.direction, flow.side);
  if (side != guard.side) guards_->wait(k, side, flow.rounding);
}

void GuardSides::arm(bool at_start) {
  guards_->see_reads(present_->g);
  for (const std::size_t k : guards_->active().crossings()) arm_crossing(k, at_start);
  for (const std::size_t k : guards_->active().relations()) {
    guards_->stay(k, present_->g[k]);
    relations_->arm(k);
    mark_armed_at(k);
  }
}

void GuardSides::arm_crossing(std::size_t k, bool at_start) {
  const bool goes_on = !at_start && is_untouched(k) && !crossings_->may_be_struck(k);
  if (!goes_on && present_->now(k).turned_beside_root) continue_beside_root(k);
  guards_->stay(k, present_->g[k]);
  if (goes_on) return forget_firing(k);
  if (holds_->of_guard(k).monitor.holding)
    contacts_->arm_crossing(k);
  else
    crossings_->arm(k, at_start);
  mark_armed_at(k);
}

/// Notes when a guard fired. That is kept through other instants until the flow has taken the guard clearly off
/// zero: the firing of another block says nothing about its side.
void GuardSides::mark_armed_at(std::size_t k) {
  const GuardNow& now = present_->now(k);
  if (!now.fired) return forget_firing(k);
  guards_->mark_armed_at(k, (*guards_)[k].at_zero() ? present_->t : not_armed,
                         present_->t + now.clear_after);
}

/// Forgets the last firing of a guard that the flow has taken clearly off zero since.
void GuardSides::forget_firing(std::size_t k) {
  if (!(present_->t < (*guards_)[k].clear_at)) guards_->mark_armed_at(k, not_armed, not_armed);
}

}  // namespace saltus
