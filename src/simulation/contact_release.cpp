// Guards of blocks at rest: they release their blocks when the surface moves away, or when another
// block writes the states.
#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/contact_decisions.hpp"
#include "saltus/simulation/detail/contact_guards.hpp"

namespace saltus {

ContactGuards::Taken ContactGuards::take(const Firing& firing) {
  SurfaceContact* contact = contacts_.empty() ? nullptr : contacts_.on(firing.slot);
  if (firing.from == Firing::lifts_off) {
    if (contact == nullptr) return Taken::yes;
    let_go(*contact, -contact->pressed);
    return Taken::let_go;
  }
  if (present_->pass > 0 || contact == nullptr) return Taken::no;
  if (wake(*contact)) return Taken::let_go;
  present_->contact_changed = true;
  return Taken::yes;
}

/// Handles a contact whose surface begins to move, or whose flow leads off the surface. True if it
/// releases its blocks.
bool ContactGuards::wake(SurfaceContact& contact) {
  const std::size_t k = contact.guard();
  const double t = present_->t;
  double* x = machine_->x.data();
  if (!contact.carried) machine_->guards_at(t, x, present_->g.data());
  const double g = present_->g[k];
  const auto may_be_carried = [&] {
    return !contact.members.empty() && contacts_.settle(contact, t, x) &&
           contacts_.lift(contact, t, x) < 0.0;
  };
  switch (decide_waking(contact.carried, g, contact.pressed, may_be_carried)) {
    case Waking::carry:
      if (!contacts_.follows(contact, t, x)) {  // the surface goes through the block
        let_go(contact, g * contact.pressed > 0.0 ? contact.pressed : -contact.pressed);
        return true;
      }
      contact.carried = contact.has_place = present_->outcome.restart = true;
      machine_->guards_at(t, x, present_->g.data());  // the block has been put on its surface
      return false;
    case Waking::stay:
      contact.error = error_after_wavering(contact.error, g);
      return false;
    case Waking::release:
      break;
  }
  let_go(contact, -contact.pressed);
  return true;
}

/// Releases the blocks of a contact to a side of its guard. The distance from a falling surface grows
/// as the third power of time, so the guard is at zero until it exceeds the tolerance.
void ContactGuards::let_go(SurfaceContact& contact, int side) {
  const std::size_t k = contact.guard();
  const GuardGroup& group = group_of(k);
  const double error = std::max(contact.error, flow_->tolerance(contact.slot, contact.opaque));
  leave(k);
  guards_->wait(k, side, error);
  if (group.is_crossing()) return holds_->release(holds_->of_guard(k));
  guards_->keep_truth(k, false);
  machine_->truth_at(group.index, (*guards_)[k].entry) = side > 0 ? 1.0 : 0.0;
}

void ContactGuards::look_at_held(std::size_t k) {
  const SurfaceContact* contact = contacts_.on(static_cast<int>(k));
  const int pressed = firing_side(group_of(k).direction);
  const double error = contact ? contact->error : (*guards_)[k].error;
  const Held then = decide_held(present_->g[k], error, pressed);
  if (then == Held::apply_again) present_->fire(k, -pressed);
  if (then != Held::release) return;
  leave(k);
  holds_->release(holds_->of_guard(k));
  guards_->turn(k, -pressed);
}

bool ContactGuards::still_at_rest(std::size_t k) {
  SurfaceContact* contact = contacts_.on(static_cast<int>(k));
  if (contact == nullptr) return false;
  if (contact->opaque) return contacts_.lift(*contact, present_->t, machine_->x.data()) < 0.0;
  return is_pressed(present_->g[k], contact->error, contact->pressed);
}

void ContactGuards::keep_relations_of(int edge) {
  for (const std::size_t k : scope_->deciders[edge]) {
    present_->note(k).frozen = true;
    guards_->keep_truth(k, true);
  }
}

// --- holds that end in a commit

void ContactGuards::release_unseen(Unseen why) {
  for (const std::size_t k : scope_->crossings) {
    Holds::Hold& hold = holds_->of_guard(k);
    if (!hold.monitor.holding || present_->now(k).fired_in_pass || (*guards_)[k].active) continue;
    const bool moves = (*guards_)[k].phase == Phase::carried;
    if (why == Unseen::by_control && !moves) continue;
    leave(k);
    holds_->release(hold);
  }
}

void ContactGuards::release_kicked() {
  for (const std::size_t k : scope_->crossings) {
    Holds::Hold& hold = holds_->of_guard(k);
    if (!holds_->kicked(hold) || present_->now(k).fired_in_pass) continue;
    leave(k);
    holds_->release(hold);
    guards_->turn(k, 0);
  }
  for (const std::size_t e : scope_->edges) {
    const bool own = edges_->is_carried(e) || edges_->has_fired(e);
    if (!own && holds_->kicked(holds_->of_edge(e))) release_kicked_edge(e);
  }
}

void ContactGuards::release_kicked_edge(std::size_t e) {
  holds_->release(holds_->of_edge(e));
  for (const std::size_t k : scope_->deciders[e]) {
    if (!(*guards_)[k].rests) continue;
    leave(k);
    guards_->keep_truth(k, false);
  }
}

}  // namespace saltus
