// Guards of blocks at rest: their contacts are found, and they are armed.
#include "saltus/simulation/detail/contact_guards.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/simulation/detail/contact_decisions.hpp"

namespace saltus {

ContactGuards::ContactGuards(const Scope& scope, Machine& machine, GuardSet& guards,
                             const SimulatorOptions& options, Flow& flow, Edges& edges,
                             Holds& holds, const Transition& transition, Present& present)
    : scope_(&scope),
      machine_(&machine),
      guards_(&guards),
      flow_(&flow),
      edges_(&edges),
      holds_(&holds),
      transition_(&transition),
      present_(&present),
      contacts_(machine, options) {}

void ContactGuards::begin() {
  contacts_.clear();
  engage();
}

const GuardGroup& ContactGuards::group_of(std::size_t k) const {
  return machine_->plan().guard((*guards_)[k].group);
}

void ContactGuards::engage() {
  flow_->forget_looks();  // a carried block is elsewhere
  machine_->carry_by(contacts_.moving() ? &contacts_ : nullptr);
}

// --- the contact of a guard

/// The contact of a guard, made if there is none yet. Null if no block rests on this guard alone.
SurfaceContact* ContactGuards::contact_of(std::size_t k) {
  const bool crossing = group_of(k).is_crossing();
  if (crossing ? !holds_->of_guard(k).monitor.holding : !(*guards_)[k].rests) return nullptr;
  return crossing ? contact_of_crossing(k) : contact_of_relation(k);
}

SurfaceContact* ContactGuards::contact_of_crossing(std::size_t k) {
  if (SurfaceContact* known = contacts_.on(static_cast<int>(k))) return known;
  const GuardGroup& group = group_of(k);
  const Holds::Hold& hold = holds_->of_guard(k);
  if (hold.states.empty()) return nullptr;
  SurfaceContact& made = contacts_.add(static_cast<int>(k));
  engage();
  made.pressed = firing_side(group.direction);
  made.states.assign(hold.states.begin(), hold.states.end());
  if (const ResetMap& map = machine_->plan().crossing_of(group).reset_map)
    made.members.push_back({hold.leaf, &map, hold.entry});
  return &made;
}

/// Whether the block that an edge resets rests on one relation only.
bool ContactGuards::rests_on_one(std::size_t e) const {
  return holds_->of_edge(e).monitor.holding && machine_->plan().edges[e].relations.size() == 1;
}

/// The contact of a relation. It is made anew when another block has come to rest on it.
SurfaceContact* ContactGuards::contact_of_relation(std::size_t k) {
  const GuardGroup& group = group_of(k);
  const Plan& plan = machine_->plan();
  std::size_t count = 0, states = 0;
  for (const std::size_t e : scope_->decided[k])
    if (rests_on_one(e)) ++count, states += holds_->of_edge(e).states.size();
  SurfaceContact* known = contacts_.on(static_cast<int>(k));
  if (known && known->members.size() == count) return known;
  if (states == 0) return nullptr;
  SurfaceContact& made = contacts_.add(static_cast<int>(k));
  engage();
  made.pressed = machine_->truth_at(group.index, (*guards_)[k].entry) != 0.0 ? 1 : -1;
  made.opaque = group.is_opaque();
  for (const std::size_t e : scope_->decided[k]) {
    if (!rests_on_one(e)) continue;
    const std::span<const Index> rest = holds_->of_edge(e).states;
    made.members.push_back({plan.edges[e].leaf, &edges_->reset_of(e).reset_map, 0});
    made.states.insert(made.states.end(), rest.begin(), rest.end());
  }
  return &made;
}

void ContactGuards::leave(std::size_t k) {
  if (contacts_.on(static_cast<int>(k)) == nullptr) return;
  contacts_.remove(static_cast<int>(k));
  engage();
  guards_->leave_rest(k);
}

// --- arming

void ContactGuards::arm_crossing(std::size_t k) {
  const Guard& guard = (*guards_)[k];
  const Departure::Side flow = flow_->side(group_of(k), static_cast<Index>(k), 0.0, 0);
  const SurfaceContact* known = contacts_.on(static_cast<int>(k));
  const double before = present_->now(k).fired ? present_->error_so_far(k)
                        : known                ? known->error
                                               : guard.error;
  if (SurfaceContact* contact = contact_of(k))
    arm(*contact, contact_error(flow.rounding, present_->g[k], before, present_->now(k).jump));
}

/// Begins to watch a relation at rest. The value of an opaque boolean has no meaning at rest. One of
/// several relations that hold a block may be far from its zero: it is armed on its side already.
void ContactGuards::arm_relation(std::size_t k) {
  const bool opaque = group_of(k).is_opaque();
  const bool on_its_side = sign_of(present_->g[k]) == (*guards_)[k].side;
  if (!opaque && on_its_side && !present_->now(k).fired && contact_of(k) == nullptr) return;
  const SurfaceContact* known = contacts_.on(static_cast<int>(k));
  double error = known ? known->error : 0.0;
  if (!opaque && !(known && known->carried)) {
    const Departure::Side flow = flow_->side(group_of(k), static_cast<Index>(k), 0.0, 0);
    const double fired = present_->now(k).fired ? present_->error_so_far(k) : 0.0;
    error = contact_error(flow.rounding, present_->g[k], std::max(error, fired));
  }
  guards_->wait(k, (*guards_)[k].side, error);
  if (SurfaceContact* contact = contact_of(k))
    arm(*contact, error);
  else if (opaque)
    guards_->turn(k, 0);
}

/// Arms the guard of a contact. If the surface moves, the block is carried, and the guard is the
/// lift off the surface. The contact ends if the flow led into the surface before and leads off it
/// now.
void ContactGuards::arm(SurfaceContact& contact, double error) {
  const std::size_t k = contact.guard();
  contact.error = error;
  flow_->forget_looks();  // the block is put on its surface
  if (!contact.members.empty() && !follow_surface(contact)) return;
  engage();
  if (contact.carried)
    guards_->carry(k);
  else if (contact.opaque)
    guards_->wait(k, 0, contact.error);
  else
    guards_->rest(k, contact.pressed, contact.error);
}

/// A contact begins. Returns whether its block was moved: it is put exactly at rest where the last reset
/// left a flight too short to be seen.
bool ContactGuards::place(SurfaceContact& contact) {
  const double t = present_->t;
  double* x = machine_->x.data();
  contacts_.find_place(contact, t, x);
  const bool placed = transition_->writes().of(group_of(contact.guard())) > 0 &&
                      contacts_.settle_on_surface(contact, t, x);
  present_->outcome.restart = present_->outcome.restart || placed;
  present_->placed = present_->placed || placed;
  contacts_.choose_look_ahead(contact, t, x, present_->longest);
  return placed;
}

/// Finds out whether the contact is carried, and its lift. False if its flow leads off the surface.
bool ContactGuards::follow_surface(SurfaceContact& contact) {
  using thresholds::kept_error;
  const double t = present_->t, longest = present_->longest;
  double* x = machine_->x.data();
  const bool placed = contact.look_ahead == 0.0 && place(contact);
  const bool moves = contact.carried || contacts_.moves(contact, t, x, longest);
  if (moves) {
    contact.has_place = contacts_.settle_on_surface(contact, t, x);
    contact.carried = contacts_.follows(contact, t, x);
  }
  if (placed) {
    // The reset maps leave the block beside its surface by a rounding, of either sign.
    const double beside = std::abs(contacts_.guard(contact, t, x));
    contact.error = std::max(contact.error, std::min(beside, kept_error * contact.error));
  }
  const double lift = contacts_.lift(contact, t, x);
  const Pressure pressure = decide_pressure(contact.carried, contact.pressed_on, lift);
  contact.carried = pressure.carried, contact.pressed_on = pressure.pressed_on;
  if (pressure.lifts_off) present_->firings.push_back({contact.slot, Firing::lifts_off});
  if (contact.carried) guards_->g[contact.slot] = guard_of_lift(lift);
  return !pressure.lifts_off;
}

std::vector<Continuation::Contact> ContactGuards::save() const {
  std::vector<Continuation::Contact> saved;
  for (const SurfaceContact& contact : contacts_.all())
    saved.push_back({contact.slot, contact.pressed_on,
                     std::max(contact.look_ahead, contact.earlier_look_ahead)});
  return saved;
}

/// Takes over what an earlier piece of the run knew of a contact. The rest of a run decides how far the
/// flow is looked ahead, so the lift may have another sign in this piece though nothing has turned:
/// then the look ahead of the earlier pieces is kept. It is the longest of them, because a short piece
/// looks ahead too little to see more than rounding.
void ContactGuards::take_over(SurfaceContact& contact, const Continuation::Contact& saved) {
  contact.pressed_on = saved.pressed_on, contact.earlier_look_ahead = saved.look_ahead;
  if (!saved.pressed_on || saved.look_ahead == 0.0 || contact.members.empty()) return;
  const auto leads_off = [&] {
    return contacts_.lift(contact, present_->t, machine_->x.data()) > 0.0;
  };
  place(contact);
  if (!leads_off()) return;
  const double chosen = std::exchange(contact.look_ahead, saved.look_ahead);
  if (leads_off()) contact.look_ahead = chosen;
}

void ContactGuards::load(const std::vector<Continuation::Contact>& saved) {
  // The guard of a part that is not executed is armed when it is seen again.
  for (const Continuation::Contact& known : saved) {
    const auto k = static_cast<std::size_t>(known.guard);
    SurfaceContact* contact = (*guards_)[k].active ? nullptr : contact_of(k);
    if (contact != nullptr)
      contact->pressed_on = known.pressed_on, contact->earlier_look_ahead = known.look_ahead;
  }
  for (const std::size_t k : guards_->active().all) {
    SurfaceContact* contact = contact_of(k);
    if (contact == nullptr) continue;
    const auto known = std::ranges::find(saved, contact->slot, &Continuation::Contact::guard);
    take_over(*contact, known == saved.end() ? Continuation::Contact{} : *known);
    arm(*contact, (*guards_)[k].error);
  }
}

}  // namespace saltus
