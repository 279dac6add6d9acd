// Arming: on which side every guard stands when integration goes on.
#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// `hair`: how far the location left the guard from zero; nothing within it counts as off zero.
Departure::Side Instant::side_of(const GuardGroup& group, Index slot, double hair, int expected) {
  if (!flowed_) departure_.from(t_, machine_->x, longest_);
  flowed_ = true;
  return departure_.of(group, slot, hair, expected);
}

/// Sides for the solver. A guard that stands at zero, or just fired, takes the side the flow takes
/// it to.
void Instant::arm(bool at_start) {
  for (std::size_t k : watch_->active) {
    const GuardGroup& group = group_of(k);
    watch_->g[k] = watch_->slots[k].base = g_[k];
    armed_at_[k] = nan;
    if (group.kind != GuardGroup::Kind::crossing)
      arm_relation(group, k);
    else if (slot_rests_[k].monitor.holding)
      arm_crossing_at_rest(k);
    else
      arm_crossing(group, k, at_start);
    if (now_[k].fired && watch_->slots[k].fresh) armed_at_[k] = t_;
  }
}

/// What the guard's author said of a guard that begins at zero or beyond it: true if that settled
/// it.
bool Instant::begin_on_firing_side(const GuardGroup& group, std::size_t k) {
  const AtStart wish = crossing_of(group).at_start;
  if (wish == AtStart::automatic || group.direction == Direction::edge_detection) return false;
  const double g = firing_side(group.direction) * g_[k];
  const bool there = g == 0.0 || (g > 0.0 && group.direction != Direction::crosses_zero);
  if (!there) return false;
  if (wish == AtStart::error) {
    throw SimulationError(
        text("t = ", t_, " s: guard '", group.name, "' begins ",
             g == 0.0 ? "at zero" : "beyond zero", " (", g_[k],
             "), and its at_start is \"error\"; begin on its armed side, or choose "
             "\"auto\", \"ignore\" or \"fire\""),
        t_, leaf(group.leaf).path);
  }
  GuardSlot& slot = watch_->slots[k];
  if (wish == AtStart::fire) {
    firings_.push_back({static_cast<int>(k), -firing_side(group.direction)});
    return true;
  }
  if (g != 0.0) return false;  // beyond zero it waits in any case
  const Departure::Side flow = side_of(group, static_cast<Index>(k), 0.0, 0);
  slot.side = static_cast<signed char>(flow.side);
  slot.band = flow.rounding, slot.fresh = true;
  return true;
}

void Instant::arm_crossing(const GuardGroup& group, std::size_t k, bool at_start) {
  GuardSlot& slot = watch_->slots[k];
  const bool entered = entered_ && !was_active_[k];
  if (!now_[k].fired && (at_start || entered) && begin_on_firing_side(group, k)) return;
  if (!now_[k].fired && !at_zero(group, k, entered)) return;
  if (slot.fresh && !now_[k].fired && !wrote_x_) return;  // dormant since before
  const auto number = static_cast<Index>(k);
  const bool either = group.direction == Direction::crosses_zero;
  const int falls = firing_side(group.direction);
  const int from = now_[k].fired    ? from_[k]
                   : !either        ? -falls
                   : slot.side != 0 ? slot.side
                                    : -falls;
  const double hair = now_[k].fired ? hair_of(k) : entered || slot.fresh ? std::abs(g_[k]) : 0.0;
  Departure::Side flow = side_of(group, number, hair, now_[k].fired ? from : 0);
  slot.band = flow.rounding;
  // A hop lower than the tolerance begins on the other side than the one it was seen to end on.
  if (entered && !now_[k].fired && flow.side * departure_.slope(group, number) < 0.0)
    flow.side = -flow.side;
  const bool its_side = either ? flow.side != 0 : flow.side == falls;
  if (entered && has_effect(group) && its_side && turned_round(group, number, flow.side)) {
    // sliding: both modes lead to the surface
    firings_.push_back({static_cast<int>(k), -flow.side});
  } else if (now_[k].fired) {
    arm_fired(group, k, from, flow);
  } else {
    arm_at_zero(group, k, flow, at_start);
  }
}

/// How far the location of a root left a guard from zero. Not where it fired on leaving its band:
/// bands made of bands would grow without end.
double Instant::hair_of(std::size_t k) const {
  return std::isnan(now_[k].flight) ? 4.0 * std::abs(now_[k].g_minus) : 1.01 * std::abs(g_[k]);
}

/// Whether a guard that has not fired in this instant stands at zero; in a mode just entered also
/// if rounding left it a hair off.
bool Instant::at_zero(const GuardGroup& group, std::size_t k, bool entered) {
  const GuardSlot& slot = watch_->slots[k];
  if (g_[k] == 0.0 || (slot.fresh && std::abs(g_[k]) <= slot.band)) return true;
  if (!entered) return false;
  if (!flowed_) departure_.from(t_, machine_->x, longest_), flowed_ = true;
  // As far as it gets within the rounding of the time cannot be told from zero either.
  const auto slot_number = static_cast<Index>(k);
  const double time = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(t_);
  const double moved = time * std::abs(departure_.slope(group, slot_number));
  return std::abs(g_[k]) <= departure_.rounding(slot_number) + moved;
}

/// At zero without having fired. A guard with an effect that the flow takes to its firing side is
/// in contact, and fires at once, if a run starts so or if a reset just turned the flow round. All
/// others wait until they have been clearly off zero. Where the flow keeps it at zero it is
/// dormant: on leaving zero to its firing side it fires.
void Instant::arm_at_zero(const GuardGroup& group, std::size_t k, Departure::Side flow,
                          bool at_start) {
  GuardSlot& slot = watch_->slots[k];
  const bool either = group.direction == Direction::crosses_zero;
  const int falls = firing_side(group.direction);
  if (group.direction == Direction::edge_detection) return;
  const int armed = either ? slot.side : -falls;
  const bool across = flow.side != 0 && (either ? flow.side == -armed : flow.side == falls);
  const bool starts = at_start && flow.side == falls &&
                      (!either || departure_.slope(group, static_cast<Index>(k)) == 0.0);
  const bool turned = wrote_x_ && across && (either || slot.side != falls);
  if (has_effect(group) && (starts || turned))
    firings_.push_back({static_cast<int>(k), -flow.side});
  const bool dormant = flow.side == 0 && has_effect(group) && (either || slot.side != falls);
  slot.side = static_cast<signed char>(dormant ? armed : flow.side);
  slot.fresh = true;
}

/// After it has fired: at rest if the flow leads straight back, else armed where the flow goes.
void Instant::arm_fired(const GuardGroup& group, std::size_t k, int from, Departure::Side flow) {
  GuardSlot& slot = watch_->slots[k];
  const bool reset = static_cast<bool>(crossing_of(group).reset_map);
  if (reset && flow.side == -from && from * g_[k] > slot.band) {
    // Clearly on its armed side, where another reset may have put it: about to cross, not at zero.
    slot.side = static_cast<signed char>(from), slot.fresh = false, slot.band = 0.0;
    return;
  }
  slot.fresh = true;
  // What a passed-through guard leaves a plateau to is no matter; a reset that wrote keeps it
  // armed.
  slot.side = static_cast<signed char>(flow.side != 0 ? flow.side : reset && wrote_x_ ? from : 0);
  const bool low = reset && too_low(group, k);
  const bool back = reset && (flow.side == -from || low) && std::abs(g_[k]) <= slot.band;
  if (!back) return;
  if (effects_ > 1 && reset_turns(group, k, from)) {
    // another reset sent it back: it fires again
    firings_.push_back({static_cast<int>(k), from});
    return;
  }
  if (!low && !rests(group, static_cast<Index>(k), from)) return;
  Rest& rest = slot_rests_[k];
  slot.side = static_cast<signed char>(from);
  slot.band = std::abs(g_[k]);  // without a monitor it fires again as soon as it can
  if (!rest.monitor.on()) {
    outcome_.stuck = true;
    return;
  }
  come_to_rest(rest, t_, false);
  if (rest.monitor.holding) arm_crossing_at_rest(k);
}

/// Whether the flight that ended here was too low to be told from rest: its height, slope times a
/// quarter of its time for a parabola, is within the band.
bool Instant::too_low(const GuardGroup& group, std::size_t k) {
  if (std::isnan(now_[k].flight) || !wrote_x_) return false;
  departure_.from(t_, x_minus_, longest_);
  flowed_ = false;
  return std::abs(departure_.slope(group, static_cast<Index>(k))) * now_[k].flight <=
         4.0 * watch_->slots[k].band;
}

/// Whether the guard's own reset map, applied to the state now, sends the flow off to its armed
/// side.
bool Instant::reset_turns(const GuardGroup& group, std::size_t k, int from) {
  const PlanLeaf& of = leaf(group.leaf);
  trial_ = machine_->x, trial_z_ = machine_->z;
  machine_->evaluate_instant(t_);
  At at = machine_->at(static_cast<std::size_t>(group.leaf), t_);
  at.entry = static_cast<Index>(k) - group.slot;
  int mode = at.mode;
  Next next({trial_.data() + of.x, of.nx}, {trial_z_.data() + of.z, of.nz}, mode, of.path);
  crossing_of(group).reset_map(*of.system, at, next);
  departure_.from(t_, trial_, longest_);
  flowed_ = false;
  return from * departure_.slope(group, static_cast<Index>(k)) > 0.0;
}

/// A relation near its zero may only leave it, not cross it, until it has been clearly off.
void Instant::arm_relation(const GuardGroup& group, std::size_t k) {
  GuardSlot& slot = watch_->slots[k];
  if (resting_[k]) return arm_relation_at_rest(k);
  const int now = (g_[k] > 0.0) - (g_[k] < 0.0);
  if (group.kind == GuardGroup::Kind::opaque) {
    slot.side = static_cast<signed char>(truth_of(k) != 0.0 ? 1 : -1);
    return;
  }
  if (now == slot.side && !now_[k].fired) return;
  if (now_[k].frozen) {
    slot.fresh = true;
    slot.band = std::abs(g_[k]);
    return;
  }
  const Departure::Side flow =
      side_of(group, static_cast<Index>(k), now_[k].fired ? hair_of(k) : 0.0, slot.side);
  slot.fresh = true;
  slot.band = flow.rounding;
  if (flow.side != 0 && flow.side != slot.side)
    firings_.push_back({static_cast<int>(k), slot.side});
}

/// After a reset, the flow leads straight back across the guard: nothing can move until something
/// else does. Not so where the guard was merely passed through: there the flow before the reset
/// went the same way.
bool Instant::rests(const GuardGroup& group, Index slot, int from) {
  if (!wrote_x_) return false;
  if (!flowed_) departure_.from(t_, machine_->x, longest_);
  const double onward = -from * departure_.slope(group, slot);
  if (!(onward > 0.0)) return true;
  departure_.from(t_, x_minus_, longest_);
  flowed_ = false;
  const double before = -from * departure_.slope(group, slot);
  return !(before > 0.0 && onward > 1e-6 * before);
}

/// Whether the flow of the mode before led a guard that stands at zero the other way: both lead to
/// the same surface.
bool Instant::turned_round(const GuardGroup& group, Index slot, int side) {
  flow_before_.resize(machine_->x.size());
  std::swap(machine_->modes, modes_before_);
  machine_->derivative(t_, machine_->x.data(), flow_before_.data());
  std::swap(machine_->modes, modes_before_);
  const double before = departure_.slope_along(flow_before_, group, slot);
  return side > 0 ? before < 0.0 : before > 0.0;
}

}  // namespace saltus
