// Arming: on which side every guard stands when integration goes on; holds and releases.
#include "saltus/simulation/instant.hpp"

namespace saltus {

Instant::Instant(Machine& machine, Watch& watch, const SimulatorOptions& options,
                        Results& results)
    : machine_(&machine),
      watch_(&watch),
      options_(&options),
      results_(&results),
      departure_(machine, options) {
  const auto slots = static_cast<std::size_t>(plan().guard_slots);
  watch.slots.resize(slots), watch.g.assign(slots, 1.0), g_.assign(slots, 1.0),
      g_minus_.assign(slots, 0.0);
  watch.scan_points = options.event_scan_points;
  for (auto* marks : {&fired_, &fired_now_, &frozen_, &resting_, &was_active_})
    marks->assign(slots, 0);
  group_of_slot_.resize(slots), from_.assign(slots, 0);
  slot_monitors_.resize(slots);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plan().guards.size(); ++i) {
    const GuardGroup& group = plan().guards[i];
    names.push_back(group.name);
    for (Index s = 0; s < group.size; ++s) {
      const auto k = static_cast<std::size_t>(group.slot + s);
      group_of_slot_[k] = static_cast<int>(i);
      watch.slots[k].direction = group.direction;
      watch.slots[k].monitor = group.monitor;
      watch.slots[k].jumps = group.kind == GuardGroup::Kind::opaque;
    }
    if (group.kind == GuardGroup::Kind::crossing && crossing_of(group).reset_map) {
      slot_monitors_[static_cast<std::size_t>(group.slot)] =
          ZenoMonitor(crossing_of(group).zeno_tolerance.value_or(options.zeno_tolerance));
    }
  }
  for (const EdgeWatch& edge : plan().edges) {
    names.push_back(edge.name);
    edge_monitors_.emplace_back(reset_of(edge).zeno_tolerance.value_or(options.zeno_tolerance));
  }
  for (const ScheduledEvent& event : plan().schedule) names.push_back(event.name);
  edge_values_.assign(plan().edges.size(), 0), carried_.assign(plan().edges.size(), 0);
  counts_.assign(names.size(), 0);
  results.events.begin(std::move(names));
}

void Instant::begin(double t, Recorder* recorder) {
  t_ = t, jump_ = 0, recorder_ = recorder;
  std::ranges::fill(counts_, 0);
  wrote_x_ = flowed_ = false;
  std::ranges::fill(fired_, 0), std::ranges::fill(frozen_, 0), std::ranges::fill(resting_, 0);
  for (auto* monitors : {&slot_monitors_, &edge_monitors_}) {
    for (ZenoMonitor& monitor : *monitors) monitor.forget();
  }
  watch_->fired.clear(), watch_->monitors.clear(), results_->events.clear();
  for (std::size_t k = 0; k < watch_->slots.size(); ++k) {
    GuardSlot& slot = watch_->slots[k];
    slot.direction = plan().guards[static_cast<std::size_t>(group_of_slot_[k])].direction;
    slot.side = 0, slot.fresh = false, slot.band = 0.0, slot.active = false;
  }
  select_guards();
  // Relations may read each other: once round for each of them is enough, or they chase each other.
  for (std::size_t round = 0; round <= plan().guards.size(); ++round) {
    bool changed = false;
    machine_->evaluate_instant(t);
    if (!plan().guards.empty()) machine_->guards(t, machine_->x.data(), g_.data());
    for (const GuardGroup& group : plan().guards) {
      if (group.kind == GuardGroup::Kind::crossing) continue;
      const Node& node = plan().node(group.index);
      const bool at_zero = node.relation && plan().relation_of(node).true_at_zero;
      for (Index s = 0; s < group.size; ++s) {
        const double g = g_[static_cast<std::size_t>(group.slot + s)];
        const bool truth = g > 0.0 || (g == 0.0 && at_zero);
        double& value = machine_->signal(group.index)[s];
        changed = changed || (value != 0.0) != truth;
        value = truth ? 1.0 : 0.0;
        watch_->slots[static_cast<std::size_t>(group.slot + s)].side = truth ? 1 : -1;
      }
    }
    if (!changed) break;
  }
  for (std::size_t k = 0; k < watch_->slots.size(); ++k) {
    if (plan().guards[static_cast<std::size_t>(group_of_slot_[k])].kind ==
        GuardGroup::Kind::crossing)
      watch_->follow(k, g_[k]);
    else
      watch_->g[k] = g_[k];
  }
  for (std::size_t e = 0; e < plan().edges.size(); ++e)
    edge_values_[e] = machine_->truth(plan().edges[e].node);
}

void Instant::select_guards() {
  machine_->select_guards();
  watch_->active.clear();
  for (int i : machine_->active_guards()) {
    const GuardGroup& group = plan().guards[static_cast<std::size_t>(i)];
    for (Index s = 0; s < group.size; ++s)
      watch_->active.push_back(static_cast<std::size_t>(group.slot + s));
  }
  for (std::size_t k = 0; k < was_active_.size(); ++k)
    was_active_[k] = std::exchange(watch_->slots[k].active, false);
  for (std::size_t k : watch_->active) {
    GuardSlot& slot = watch_->slots[k];
    slot.active = true;
    if (!was_active_[k]) slot.side = 0, slot.fresh = false;  // a mode just entered: no side yet
  }
}

/// `hair`: how far the location left the guard from zero; nothing within it counts as off zero.
Departure::Side Instant::side_of(const GuardGroup& group, Index slot, double hair,
                                        int expected) {
  if (!flowed_) departure_.from(t_, machine_->x, longest_);
  flowed_ = true;
  return departure_.of(group, slot, hair, expected);
}

/// Sides for the solver. A guard that stands at zero, or just fired, takes the side the flow takes
/// it to.
void Instant::arm(bool at_start) {
  if (plan().guards.empty()) return;
  for (int i : machine_->active_guards()) {
    const GuardGroup& group = plan().guards[static_cast<std::size_t>(i)];
    for (Index s = 0; s < group.size; ++s) {
      const auto k = static_cast<std::size_t>(group.slot + s);
      watch_->g[k] = watch_->slots[k].base = g_[k];
      if (group.kind != GuardGroup::Kind::crossing)
        arm_relation(group, k);
      else if (slot_monitors_[k].holding)
        arm_held(group, k);
      else if (fired_[k] || g_[k] == 0.0)
        arm_crossing(group, k, at_start);
    }
  }
}

void Instant::arm_crossing(const GuardGroup& group, std::size_t k, bool at_start) {
  GuardSlot& slot = watch_->slots[k];
  if (slot.fresh && !fired_[k]) return;  // dormant since before
  const ZeroCrossing& crossing = crossing_of(group);
  const int falls = group.direction == Direction::negative_then_non_negative
                        ? 1
                        : -1;  // side it fires on reaching
  const int from = group.direction != Direction::crosses_zero ? -falls
                   : slot.side != 0                           ? slot.side
                                                              : -falls;
  const Departure::Side flow = side_of(
      group, group.slot, fired_[k] ? 4.0 * std::abs(g_minus_[k]) : 0.0, fired_[k] ? from : 0);
  slot.band = flow.rounding;
  const bool has_effect = crossing.reset_map || crossing.end_mode;
  const bool its_side =
      group.direction == Direction::crosses_zero ? flow.side != 0 : flow.side == falls;
  if (entered_ && !was_active_[k] && has_effect && its_side && turned_round(group, flow.side)) {
    firings_.push_back(
        {static_cast<int>(k), -flow.side});  // sliding: both modes lead to the surface
    return;
  }
  if (!fired_[k]) {
    // At zero without having fired. At the start of a run a guard with a reset map that the flow
    // takes to its firing side is in contact: it fires at once. All others wait until they have
    // been clearly off zero.
    const bool contact =
        at_start && has_effect && group.direction != Direction::edge_detection &&
        flow.side == falls &&
        (group.direction != Direction::crosses_zero || departure_.slope(group, group.slot) == 0.0);
    if (contact) firings_.push_back({static_cast<int>(k), -falls});
    slot.side = static_cast<signed char>(flow.side);
    slot.fresh = false;
    return;
  }
  ZenoMonitor& monitor = slot_monitors_[k];
  if (flow.side != 0 && flow.side != from && crossing.reset_map && rests(group, group.slot, from)) {
    if (monitor.on()) {
      hold(group.leaf, monitor, source_of(Cause::crossing, group_of_slot_[k]), t_);
      arm_held(group, k);
      return;
    }
    slot.side = static_cast<signed char>(from), slot.fresh = true,
    slot.band = std::abs(g_[k]);  // fires again as soon as it can
    return;
  }
  slot.side = static_cast<signed char>(flow.side != 0 ? flow.side : from);
  slot.fresh = flow.side == 0 || flow.side == from;
}

/// A relation near its zero may only leave it, not cross it, until it has been clearly off.
void Instant::arm_relation(const GuardGroup& group, std::size_t k) {
  GuardSlot& slot = watch_->slots[k];
  const int now = (g_[k] > 0.0) - (g_[k] < 0.0);
  if (group.kind == GuardGroup::Kind::opaque) {
    const bool truth = machine_->signal(group.index)[static_cast<Index>(k) - group.slot] != 0.0;
    slot.side = static_cast<signed char>(resting_[k] ? 0
                                         : truth     ? 1
                                                     : -1);  // at rest its value says nothing
    return;
  }
  if (now == slot.side && !fired_[k]) return;
  if (frozen_[k]) {
    slot.fresh = true;
    slot.band = std::abs(g_[k]);
    return;
  }
  const Departure::Side flow =
      side_of(group, static_cast<Index>(k), fired_[k] ? 4.0 * std::abs(g_minus_[k]) : 0.0, 0);
  slot.fresh = true;
  slot.band = flow.rounding;
  if (flow.side != 0 && flow.side != slot.side)
    firings_.push_back({static_cast<int>(k), slot.side});
}

/// On hold the guard is watched the other way round: off to its armed side it lets go.
void Instant::arm_held(const GuardGroup& group, std::size_t k) {
  GuardSlot& slot = watch_->slots[k];
  const int falls = group.direction == Direction::negative_then_non_negative ? 1 : -1;
  const Departure::Side flow = side_of(group, group.slot, 0.0, 0);
  slot.side = static_cast<signed char>(falls);
  slot.direction =
      falls > 0 ? Direction::positive_then_non_positive : Direction::negative_then_non_negative;
  slot.fresh = true;
  slot.band = std::max(
      {flow.rounding, std::abs(g_[k]), fired_[k] ? 4.0 * std::abs(g_minus_[k]) : slot.band});
}

/// After a reset, the flow leads straight back across the guard: nothing can move until something
/// else does. Not so where the guard was merely passed through: there the flow before the reset
/// went the same way.
bool Instant::rests(const GuardGroup& group, Index slot, int from) {
  if (!wrote_x_) return false;
  const double onward = -from * departure_.slope(group, slot);
  if (!(onward > 0.0)) return true;
  departure_.from(t_, x_minus_, longest_);
  flowed_ = false;
  const double before = -from * departure_.slope(group, slot);
  return !(before > 0.0 && onward > 1e-9 * before);
}

/// Whether the flow of the mode before led a guard that stands at zero the other way: both lead to
/// the same surface.
bool Instant::turned_round(const GuardGroup& group, int side) {
  flow_before_.resize(machine_->x.size());
  std::swap(machine_->modes, modes_before_);
  machine_->derivative(t_, machine_->x.data(), flow_before_.data());
  std::swap(machine_->modes, modes_before_);
  const double before = departure_.slope_along(flow_before_, group, group.slot);
  return side > 0 ? before < 0.0 : before > 0.0;
}

void Instant::hold(int leaf_index, ZenoMonitor& monitor, int source, double predicted) {
  monitor.holding = true;
  outcome_.horizon = std::numeric_limits<double>::infinity();
  machine_->held[static_cast<std::size_t>(leaf_index)] = 1;
  outcome_.restart = true;
  flowed_ = false;
  log(EventKind::zeno_enter, source, leaf_index, 0, predicted);
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
    ZenoMonitor& monitor = edge_monitors_[static_cast<std::size_t>(e)];
    if (monitor.holding || std::ranges::find(edge.relations, node) == edge.relations.end())
      continue;
    if (monitor.on())
      hold(edge.leaf, monitor, source_of(Cause::edge, e), t_);
    else
      all = false;
  }
  return all;
}

void Instant::release(int leaf_index, ZenoMonitor& monitor, int source) {
  monitor.forget();
  machine_->held[static_cast<std::size_t>(leaf_index)] = 0;
  outcome_.restart = true;
  flowed_ = false;
  log(EventKind::zeno_release, source, leaf_index, 0);
}

void Instant::log(EventKind kind, int source, int leaf_index, int direction,
                         double predicted) {
  ++results_->statistics.events;
  if (kind != EventKind::zeno_enter && kind != EventKind::zeno_release)
    ++counts_[static_cast<std::size_t>(source)];
  if (!options_->record_events) return;
  const PlanLeaf& of = leaf(leaf_index);
  const double* after = x_next_.size() > 0 ? x_next_.data() + of.x : nullptr;
  results_->events.add(
      {t_, event_jump_, direction, kind, source, predicted, 0, static_cast<std::size_t>(of.nx)},
      machine_->x.data() + of.x, after);
}

std::vector<std::pair<std::string, std::int64_t>> Instant::counts() const {
  std::vector<std::pair<std::string, std::int64_t>> named;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] > 0) named.emplace_back(name_of(static_cast<int>(i)), counts_[i]);
  }
  return named;
}

void Instant::log_monitor(const MonitorHit& hit, const double* x) {
  const int group = group_of_slot_[static_cast<std::size_t>(hit.firing.slot)];
  ++counts_[static_cast<std::size_t>(group)];
  if (!options_->record_events) return;
  const PlanLeaf& of = leaf(plan().guards[static_cast<std::size_t>(group)].leaf);
  results_->events.add(
      {hit.t, jump_, -hit.firing.from, EventKind::zero_crossing, group,
       std::numeric_limits<double>::quiet_NaN(), 0, static_cast<std::size_t>(of.nx)},
      x + of.x, x + of.x);
}

}  // namespace saltus
