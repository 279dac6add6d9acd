// Holds: blocks at rest, on surfaces that stand or move, and how they get off.
#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

/// A Zeno point: it means what the guard's author said.
void Instant::come_to_rest(Rest& rest, double predicted, bool in_pass) {
  using Kind = OnZeno::Kind;
  const Kind kind = rest.on_zeno.kind();
  const bool there = kind == Kind::mode &&
                     machine_->modes[static_cast<std::size_t>(rest.leaf)] == rest.on_zeno.mode();
  if (kind == Kind::hold || there) return hold(rest, predicted);
  if (kind == Kind::stop && outcome_.zeno_stop) return;
  const std::string& name = name_of(rest.source);
  if (kind == Kind::error) {
    throw SimulationError(
        text("t = ", t_, " s: the firings of '", name, "' accumulate at t = ", predicted,
             " s (a Zeno point), and its on_zeno is \"error\"; choose \"hold\", \"stop\" or a mode "
             "to go on in"),
        t_, leaf(rest.leaf).path);
  }
  log(EventKind::zeno_enter, rest.source, rest.leaf, 0, predicted, rest.entry);
  rest.monitor.forget();
  if (kind == Kind::stop) {
    outcome_.zeno_stop = true;
  } else {
    const Action enter{rest.leaf, Cause::zeno, rest.source, -1, rest.on_zeno.mode(), false};
    in_pass ? run_action(enter) : actions_.push_back(enter);
  }
}

void Instant::hold(Rest& rest, double predicted) {
  rest.monitor.holding = true, ++holds_;
  outcome_.horizon = std::numeric_limits<double>::infinity();
  for (const Index i : rest.states) machine_->rest(i);
  outcome_.restart = true;
  flowed_ = false;
  log(EventKind::zeno_enter, rest.source, rest.leaf, 0, predicted, rest.entry);
}

void Instant::release(Rest& rest) {
  rest.monitor.forget(), --holds_;
  for (const Index i : rest.states) machine_->move(i);
  outcome_.restart = true;
  flowed_ = false;
  log(EventKind::zeno_release, rest.source, rest.leaf, 0, std::numeric_limits<double>::quiet_NaN(),
      rest.entry);
}

/// Whether a relation set off a reset in this instant, and still stands on the side that did.
bool Instant::sets_off(int node) const {
  return std::ranges::any_of(edges_fired_, [&](int e) {
    const EdgeWatch& edge = plan().edges[static_cast<std::size_t>(e)];
    const bool up = reset_of(edge).edge != Edge::falling;
    return std::ranges::find(edge.relations, node) != edge.relations.end() &&
           machine_->truth(edge.node) == up;
  });
}

/// A relation at rest holds the blocks whose resets it set off in this instant; false if one of
/// them has no monitor.
bool Instant::hold_edges_of(int node) {
  bool all = true;
  for (int e : edges_fired_) {
    const EdgeWatch& edge = plan().edges[static_cast<std::size_t>(e)];
    Rest& rest = edge_rests_[static_cast<std::size_t>(e)];
    if (rest.monitor.holding || std::ranges::find(edge.relations, node) == edge.relations.end())
      continue;
    if (rest.monitor.on())
      come_to_rest(rest, t_, false);
    else
      all = false;
  }
  return all;
}

/// The relations behind an edge keep their side: at rest their own values are rounding.
void Instant::rest_relations_of(const EdgeWatch& edge) {
  for (int node : edge.relations) {
    for (const GuardGroup& relation : plan().guards) {
      if (relation.kind == GuardGroup::Kind::crossing || relation.index != node) continue;
      for (auto k = static_cast<std::size_t>(relation.slot), s = k;
           s < k + static_cast<std::size_t>(relation.size); ++s)
        now_[s].frozen = true, resting_[s] = 1;
    }
  }
}

/// Takes out of the firings those of contacts, and those against the flow; true if a contact let
/// go.
bool Instant::look_at_firings() {
  bool off = false;
  std::erase_if(firings_, [&](const Firing& firing) {
    SurfaceContact* contact = contacts_.empty() ? nullptr : contacts_.on(firing.slot);
    if (firing.from == lifts_off) {
      if (contact != nullptr) let_go(*contact), off = true;
      return true;
    }
    if (pass_ > 0) return false;
    if (contact == nullptr) return goes_against(firing);
    off = wake(*contact) || off;
    return true;
  });
  return off;
}

/// Whether the flow leads a guard that seems to have fired to its armed side. The first step after
/// a restart, of order 1 or drowned in the rounding of its states, invents such roots while the
/// ball still rises. Only guards that have been at zero since they were armed can be mistaken so.
bool Instant::goes_against(const Firing& firing) {
  const auto k = static_cast<std::size_t>(firing.slot);
  const GuardGroup& group = group_of(k);
  if (std::isnan(armed_at_[k]) || group.monitor || group.direction == Direction::edge_detection)
    return false;
  // One that was seen clearly off zero in between is beyond doubt.
  if (group.kind != GuardGroup::Kind::opaque && !firing.fresh) return false;
  departure_.from(t_, machine_->x, t_ - armed_at_[k]);
  const double hair = 4.0 * std::abs(now_[k].g_minus);
  const Departure::Side flow = departure_.of(group, static_cast<Index>(k), hair, -firing.from);
  if (flow.side != firing.from) return false;
  GuardSlot& slot = watch_->slots[k];
  slot.side = static_cast<signed char>(firing.from), slot.fresh = true;
  slot.band = std::max({slot.band, hair, flow.rounding});
  return true;
}

/// Holds of leaves that have entered a mode which does not see the guard of the hold.
void Instant::release_unseen() {
  for (std::size_t k = 0; k < slot_rests_.size(); ++k) {
    Rest& rest = slot_rests_[k];
    if (!rest.monitor.holding || fired_now_[k] || watch_->slots[k].active) continue;
    leave_contact(k);
    release(rest);
  }
}

/// Holds whose state a reset map or an update of the same leaf has changed end: what was kicked is
/// at rest no longer. Its guards are armed anew.
void Instant::release_kicked() {
  const auto kicked = [&](const Rest& rest) {
    return rest.monitor.holding &&
           std::ranges::any_of(rest.states, [&](Index i) { return x_next_[i] != machine_->x[i]; });
  };
  for (std::size_t k = 0; k < slot_rests_.size(); ++k) {
    if (!kicked(slot_rests_[k]) || fired_now_[k]) continue;
    leave_contact(k);
    release(slot_rests_[k]);
    watch_->slots[k].side = 0;
  }
  for (std::size_t e = 0; e < edge_rests_.size(); ++e) {
    const bool own = carried_[e] != 0 ||
                     std::ranges::find(edges_fired_, static_cast<int>(e)) != edges_fired_.end();
    if (own || !kicked(edge_rests_[e])) continue;
    release(edge_rests_[e]);
    for (std::size_t k = 0; k < resting_.size(); ++k) {
      const auto& relations = plan().edges[e].relations;
      if (!resting_[k] || std::ranges::find(relations, group_of(k).index) == relations.end())
        continue;
      leave_contact(k);
      resting_[k] = 0;
    }
  }
}

}  // namespace saltus
