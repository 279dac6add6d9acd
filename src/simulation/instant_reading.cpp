// After a commit: held outputs and relations read again, and what the commit moved across zero.
#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

/// Held outputs and relations after a commit.
void Instant::read_again() {
  machine_->evaluate_instant(t_);
  if (plan().guards.empty()) return;
  for (int round = 0; round < options_->max_passes; ++round) {
    bool flipped = false;
    machine_->guards_at(t_, machine_->x.data(), g_.data());
    for (int i : machine_->active_guards()) {
      const GuardGroup& group = plan().guards[static_cast<std::size_t>(i)];
      if (group.kind == GuardGroup::Kind::crossing) continue;
      for (Index s = 0; s < group.size; ++s)
        flipped = read_relation(group, group.slot + s) || flipped;
    }
    if (!flipped) return;
    machine_->evaluate_instant(t_);
  }
}

/// The side of a relation now; true if that is a new one. At its own zero it keeps the one it has,
/// until `arm` asks where the flow goes; after it fired and a reset wrote, it takes the side the
/// flow takes it to.
bool Instant::read_relation(const GuardGroup& group, Index slot) {
  const auto k = static_cast<std::size_t>(slot);
  GuardSlot& watched = watch_->slots[k];
  if (now_[k].frozen || (resting_[k] && !reads_changed(group.index))) return false;
  if (SurfaceContact* contact = contacts_.on(static_cast<int>(k));
      contact && still_at_rest(*contact))
    return false;
  const bool truth = truth_of(k) != 0.0;
  const int crossed_to = now_[k].fired ? -from_[k] : truth ? 1 : -1;
  int side = (g_[k] > 0.0) - (g_[k] < 0.0);
  if (now_[k].fired && !wrote_x_)
    side = crossed_to;  // nothing it reads was written: its value is rounding
  const bool opaque = group.kind == GuardGroup::Kind::opaque;
  const bool touched = now_[k].fired || (now_[k].turned && g_[k] == 0.0);
  const bool unsure = wrote_x_ && touched && (!opaque || side != crossed_to);
  if (unsure) {
    const Departure::Side flow =
        side_of(group, slot, !opaque ? 4.0 * std::abs(now_[k].g_minus) : 0.0,
                opaque ? 0 : Departure::either_side);
    side = flow.side != 0 ? flow.side : crossed_to;
    const bool back = side == crossed_to && flow.side != 0;
    if (back && sets_off(group.index) && (opaque || rests(group, slot, -crossed_to))) {
      now_[k].frozen = true;
      if (hold_edges_of(group.index))
        resting_[k] = 1;
      else
        side = -crossed_to, outcome_.stuck = true;  // no monitor: it fires again as soon as it can
    }
  }
  if (side == 0) return false;
  watched.side = static_cast<signed char>(side);
  if ((side > 0) == truth) return false;
  resting_[k] = 0;
  now_[k].turned = true;
  leave_contact(k);
  truth_of(k) = side > 0 ? 1.0 : 0.0;
  if (!plan().restarting.empty()) flowed_ = false;
  return true;
}

/// Whether something that a relation reads was written in this instant. At rest its own value is
/// rounding.
bool Instant::reads_changed(int node) const {
  return std::ranges::any_of(plan().node(node).needs, [&](int need) {
    const Node& read = plan().node(need);
    if (read.rate != Rate::continuous || read.view) return changed(read.place);
    return wrote_x_ || reads_changed(need);
  });
}

/// Zero crossings that the commit moved across zero in their direction fire in the next pass.
void Instant::find_next() {
  for (std::size_t k : watch_->active) {
    const GuardGroup& group = group_of(k);
    if (group.kind != GuardGroup::Kind::crossing) continue;
    GuardSlot& slot = watch_->slots[k];
    if (slot_rests_[k].monitor.holding) {
      if (!fired_now_[k]) look_at_held(k);  // else it has only just come to rest
    } else if (fired_now_[k]) {
      slot.side = static_cast<signed char>((g_[k] > 0.0) - (g_[k] < 0.0));
      slot.base = g_[k];
    } else if (!group.monitor && watch_->crossed(k, g_[k])) {
      firings_.push_back({static_cast<int>(k), slot.side});
    } else {
      watch_->follow(k, g_[k]);
    }
  }
}

}  // namespace saltus
