// Contacts of blocks at rest: watched, carried with their surface, let go.
#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

/// The contact behind a guard at rest, made where there is none yet; null where nothing rests on it
/// alone.
SurfaceContact* Instant::contact_of(std::size_t k) {
  const bool crossing = group_of(k).kind == GuardGroup::Kind::crossing;
  if (crossing ? !slot_rests_[k].monitor.holding : !resting_[k]) return nullptr;
  return crossing ? contact_of_crossing(k) : contact_of_relation(k);
}

SurfaceContact* Instant::contact_of_crossing(std::size_t k) {
  if (SurfaceContact* known = contacts_.on(static_cast<int>(k))) return known;
  const GuardGroup& group = group_of(k);
  const Rest& rest = slot_rests_[k];
  if (rest.states.empty()) return nullptr;
  SurfaceContact& made = contacts_.add(static_cast<int>(k));
  made.pressed = firing_side(group.direction);
  made.states.assign(rest.states.begin(), rest.states.end());
  if (const ResetMap& map = crossing_of(group).reset_map)
    made.members.push_back({rest.leaf, &map, rest.entry});
  return &made;
}

/// Made anew when another block has come to rest on it.
SurfaceContact* Instant::contact_of_relation(std::size_t k) {
  const GuardGroup& group = group_of(k);
  const auto rests_here = [&](std::size_t e) {
    const auto& relations = plan().edges[e].relations;
    return edge_rests_[e].monitor.holding && relations.size() == 1 &&
           relations.front() == group.index;
  };
  std::size_t count = 0, states = 0;
  for (std::size_t e = 0; e < plan().edges.size(); ++e)
    if (rests_here(e)) ++count, states += edge_rests_[e].states.size();
  SurfaceContact* known = contacts_.on(static_cast<int>(k));
  if (known && known->members.size() == count) return known;
  if (states == 0) return nullptr;
  SurfaceContact& made = contacts_.add(static_cast<int>(k));
  made.pressed = truth_of(k) != 0.0 ? 1 : -1;
  made.opaque = group.kind == GuardGroup::Kind::opaque;
  for (std::size_t e = 0; e < plan().edges.size(); ++e) {
    if (!rests_here(e)) continue;
    const EdgeWatch& edge = plan().edges[e];
    const std::span<const Index> rest = edge_rests_[e].states;
    made.members.push_back({edge.leaf, &reset_of(edge).reset_map, 0});
    made.states.insert(made.states.end(), rest.begin(), rest.end());
  }
  return &made;
}

void Instant::leave_contact(std::size_t k) {
  if (contacts_.on(static_cast<int>(k)) == nullptr) return;
  contacts_.remove(static_cast<int>(k));
  GuardSlot& slot = watch_->slots[k];
  slot.leaving = false;
  slot.direction = group_of(k).direction;
}

/// On hold a guard is watched for leaving zero, to either side.
void Instant::arm_crossing_at_rest(std::size_t k) {
  GuardSlot& slot = watch_->slots[k];
  const Departure::Side flow = side_of(group_of(k), static_cast<Index>(k), 0.0, 0);
  const SurfaceContact* known = contacts_.on(static_cast<int>(k));
  const double before = now_[k].fired ? hair_of(k) : known ? known->band : slot.band;
  if (SurfaceContact* contact = contact_of(k))
    arm_contact(*contact, std::max({flow.rounding, std::abs(g_[k]), before}));
}

/// The same for a relation at rest. The value of an opaque boolean says nothing there.
void Instant::arm_relation_at_rest(std::size_t k) {
  GuardSlot& slot = watch_->slots[k];
  const bool opaque = group_of(k).kind == GuardGroup::Kind::opaque;
  const SurfaceContact* known = contacts_.on(static_cast<int>(k));
  double band = known ? known->band : 0.0;
  if (!opaque && !(known && known->carried)) {
    const Departure::Side flow = side_of(group_of(k), static_cast<Index>(k), 0.0, 0);
    band = std::max({band, flow.rounding, std::abs(g_[k]), now_[k].fired ? hair_of(k) : 0.0});
  }
  slot.fresh = true, slot.band = band;
  if (SurfaceContact* contact = contact_of(k))
    arm_contact(*contact, band);
  else if (opaque)
    slot.side = 0;
}

/// Watches a contact: where its surface moves it is carried, and its guard is the lift off it. It
/// ends where the flow, that led into the surface, now leads off it.
void Instant::arm_contact(SurfaceContact& contact, double band) {
  const auto k = static_cast<std::size_t>(contact.slot);
  GuardSlot& slot = watch_->slots[k];
  double* x = machine_->x.data();
  contact.band = band;
  double lift = 0.0;
  if (!contact.members.empty()) {
    if (contact.look_ahead == 0.0) {
      // Exactly at rest: what the last reset left is a flight too short to be seen.
      if (wrote_x_ && contacts_.settle(contact, t_, x)) outcome_.restart = true;
      contacts_.choose_look_ahead(contact, t_, x, longest_);
    }
    const bool moves = contact.carried || contacts_.moves(contact, t_, x, longest_);
    if (moves) contact.carried = contacts_.settle(contact, t_, x);
    lift = contacts_.lift(contact, t_, x);
    contact.carried = contact.carried && lift < 0.0;
    if (contact.pressed_on && lift > 0.0) {
      firings_.push_back({contact.slot, lifts_off});
      return;
    }
    contact.pressed_on = lift < 0.0;
  }
  contacts_.engage();
  slot.leaving = !contact.carried && !contact.opaque;
  slot.fresh = !contact.carried;
  slot.band = contact.carried ? 0.0 : band;
  slot.side = static_cast<signed char>(contact.carried ? -1 : contact.opaque ? 0 : contact.pressed);
  slot.direction = contact.carried ? Direction::negative_then_non_negative : group_of(k).direction;
  if (contact.carried) watch_->g[k] = lift;
}

/// A contact whose surface begins to move, or whose flow leads off it: true if it lets go.
bool Instant::wake(SurfaceContact& contact) {
  const auto k = static_cast<std::size_t>(contact.slot);
  double* x = machine_->x.data();
  if (!contact.carried) {
    machine_->guards_at(t_, x, g_.data());
    const bool off = g_[k] * -contact.pressed > 0.0;
    contact.carried = !contact.members.empty() && contacts_.settle(contact, t_, x) &&
                      contacts_.lift(contact, t_, x) < 0.0;
    if (contact.carried) return false;
    if (!off) {
      contact.band = std::max(contact.band, 2.0 * std::abs(g_[k]));
      return false;
    }
  }
  let_go(contact);
  return true;
}

void Instant::let_go(SurfaceContact& contact) {
  const auto k = static_cast<std::size_t>(contact.slot);
  const GuardGroup& group = group_of(k);
  const int armed = -contact.pressed;
  GuardSlot& slot = watch_->slots[k];
  // Off a surface that falls away it gets as the third power of time: until it is clear of it by
  // more than the tolerance, it is at zero.
  departure_.from(t_, machine_->x, longest_);
  flowed_ = false;
  const double band =
      std::max(contact.band, contact.opaque ? 0.0 : departure_.tolerance(contact.slot));
  leave_contact(k);
  slot.side = static_cast<signed char>(armed), slot.fresh = true, slot.band = band;
  if (group.kind == GuardGroup::Kind::crossing) return release(slot_rests_[k]);
  resting_[k] = 0;
  truth_of(k) = armed > 0 ? 1.0 : 0.0;
}

/// After a commit, the guard of a leaf on hold: off to its armed side it lets go, beyond zero the
/// reset map is applied again.
void Instant::look_at_held(std::size_t k) {
  SurfaceContact* contact = contacts_.on(static_cast<int>(k));
  const int pressed = firing_side(group_of(k).direction);
  const double band = contact ? contact->band : watch_->slots[k].band;
  if (std::abs(g_[k]) <= band) return;
  if (g_[k] * pressed < 0.0) {
    leave_contact(k);
    release(slot_rests_[k]);
    watch_->slots[k].side = static_cast<signed char>(-pressed);
  } else if (std::abs(g_[k]) > 1e3 * band) {
    firings_.push_back({static_cast<int>(k), -pressed});
  }
}

/// The same of a relation at rest: whether it still is.
bool Instant::still_at_rest(SurfaceContact& contact) {
  const auto k = static_cast<std::size_t>(contact.slot);
  if (contact.opaque) return contacts_.lift(contact, t_, machine_->x.data()) < 0.0;
  return std::abs(g_[k]) <= contact.band || g_[k] * contact.pressed > 0.0;
}

}  // namespace saltus
