// An instant's memory: made once, cleaned for each run, saved and loaded between runs; the event
// log.
#include "saltus/simulation/detail/instant.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace saltus {

namespace {

/// Names of what is declared and can never fire. Who asks for it by name made no mistake.
void add_silent(const Plan& plan, std::vector<std::string>& names) {
  for (const PlanLeaf& leaf : plan.leaves) {
    for (const ZeroCrossing& crossing : leaf.declared().zero_crossings) {
      if (crossing.direction == Direction::none)
        names.push_back(text(leaf.path, ".", crossing.name));
    }
  }
  for (const Node& node : plan.nodes) {
    if (node.relation && !node.located) names.push_back(plan.name_of(node));
  }
}

}  // namespace

Instant::Instant(Machine& machine, Watch& watch, const SimulatorOptions& options, Results& results)
    : machine_(&machine),
      watch_(&watch),
      options_(&options),
      results_(&results),
      departure_(machine, options),
      contacts_(machine, options) {
  const auto slots = static_cast<std::size_t>(plan().guard_slots);
  watch.slots.resize(slots), watch.g.assign(slots, 1.0), g_.assign(slots, 1.0);
  now_.resize(slots);
  watch.scan_points = options.event_scan_points;
  for (auto* marks : {&fired_now_, &resting_, &was_active_}) marks->assign(slots, 0);
  group_of_slot_.resize(slots), from_.assign(slots, 0);
  armed_at_.assign(slots, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plan().guards.size(); ++i) {
    const GuardGroup& group = plan().guards[i];
    names.push_back(group.name);
    for (Index s = 0; s < group.size; ++s) {
      const auto k = static_cast<std::size_t>(group.slot + s);
      group_of_slot_[k] = static_cast<int>(i);
      watch.slots[k].monitor = group.monitor;
      watch.slots[k].jumps = group.kind == GuardGroup::Kind::opaque;
    }
  }
  for (const EdgeWatch& edge : plan().edges) names.push_back(edge.name);
  for (const ScheduledEvent& event : plan().schedule) names.push_back(event.name);
  edge_values_.assign(plan().edges.size(), 0), carried_.assign(plan().edges.size(), 0);
  counts_.assign(names.size(), 0), earlier_.assign(plan().guards.size(), 0);
  add_rests();
  add_silent(plan(), names);
  results.events.begin(std::move(names));
}

/// The Zeno monitors: one for each guard with an effect, one for each edge.
void Instant::add_rests() {
  states_.resize(static_cast<std::size_t>(plan().nx));
  std::iota(states_.begin(), states_.end(), Index{0});
  const auto whole = [&](const PlanLeaf& of) {
    return std::span<const Index>(states_).subspan(static_cast<std::size_t>(of.x),
                                                   static_cast<std::size_t>(of.nx));
  };
  slot_rests_.resize(watch_->slots.size());
  for (std::size_t k = 0; k < slot_rests_.size(); ++k) {
    const GuardGroup& group = group_of(k);
    if (group.kind != GuardGroup::Kind::crossing || !has_effect(group)) continue;
    const ZeroCrossing& crossing = crossing_of(group);
    Rest& rest = slot_rests_[k];
    rest = {.monitor = ZenoMonitor(crossing.zeno_tolerance.value_or(options_->zeno_tolerance)),
            .leaf = group.leaf,
            .source = group_of_slot_[k],
            .entry = static_cast<Index>(k) - group.slot,
            .on_zeno = crossing.on_zeno};
    if (crossing.holds.empty()) {
      rest.states = whole(leaf(group.leaf));
    } else {
      std::vector<Index>& held = held_.emplace_back();
      for (int i : crossing.holds[static_cast<std::size_t>(rest.entry)])
        held.push_back(leaf(group.leaf).x + i);
      rest.states = held;
    }
  }
  for (std::size_t e = 0; e < plan().edges.size(); ++e) {
    const EdgeWatch& edge = plan().edges[e];
    const EdgeReset& reset = reset_of(edge);
    edge_rests_.push_back(
        {.monitor = ZenoMonitor(reset.zeno_tolerance.value_or(options_->zeno_tolerance)),
         .leaf = edge.leaf,
         .source = source_of(Cause::edge, static_cast<int>(e)),
         .on_zeno = reset.on_zeno,
         .states = whole(leaf(edge.leaf))});
  }
}

void Instant::begin(double t, Recorder* recorder) {
  t_ = t, jump_ = 0, recorder_ = recorder, last_source_ = -1;
  ++watch_->version;
  std::ranges::fill(counts_, 0), std::ranges::fill(earlier_, 0);
  wrote_x_ = flowed_ = false;
  std::ranges::fill(now_, SlotNow{}), std::ranges::fill(resting_, 0);
  for (auto* rests : {&slot_rests_, &edge_rests_}) {
    for (Rest& rest : *rests) rest.monitor.forget();
  }
  contacts_.clear();
  holds_ = 0;
  std::ranges::fill(armed_at_, std::numeric_limits<double>::quiet_NaN());
  watch_->fired.clear(), watch_->monitors.clear(), results_->events.clear();
  for (std::size_t k = 0; k < watch_->slots.size(); ++k) {
    GuardSlot& slot = watch_->slots[k];
    slot.direction = group_of(k).direction;
    slot.side = 0, slot.band = 0.0;
    slot.fresh = slot.active = slot.leaving = false;
  }
  select_guards();
  settle_relations(t);
  for (std::size_t k = 0; k < watch_->slots.size(); ++k) {
    if (group_of(k).kind == GuardGroup::Kind::crossing)
      watch_->follow(k, g_[k]);
    else
      watch_->g[k] = g_[k];
  }
  for (std::size_t e = 0; e < plan().edges.size(); ++e)
    edge_values_[e] = machine_->truth(plan().edges[e].node);
}

/// Relations may read each other: once round for each of them is enough, or they chase each other.
void Instant::settle_relations(double t) {
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

Continuation Instant::save() const {
  Continuation saved{.jump = jump_};
  for (const GuardGroup& group : plan().guards) {
    if (group.kind == GuardGroup::Kind::crossing) continue;
    for (Index s = 0; s < group.size; ++s)
      saved.relations.push_back(machine_->y[plan().node(group.index).place.offset + s]);
  }
  for (std::size_t k = 0; k < watch_->slots.size(); ++k) {
    const GuardSlot& slot = watch_->slots[k];
    saved.guards.push_back(
        {slot.side, from_[k], slot.fresh, resting_[k] != 0, slot.band, slot.base});
  }
  for (const auto* rests : {&slot_rests_, &edge_rests_}) {
    for (const Rest& rest : *rests) saved.firings.push_back(rest.monitor.save());
  }
  saved.edges.assign(edge_values_.begin(), edge_values_.end());
  for (std::size_t i = 0; i < earlier_.size(); ++i)
    saved.counts.push_back(earlier_[i] + counts_[i]);
  return saved;
}

/// Whether an earlier run's knowledge has the shape of this system.
bool Instant::fits(const Continuation& from) const {
  std::size_t relations = 0;
  for (const GuardGroup& group : plan().guards) {
    if (group.kind != GuardGroup::Kind::crossing) relations += static_cast<std::size_t>(group.size);
  }
  return from.relations.size() == relations && from.guards.size() == watch_->slots.size() &&
         from.firings.size() == slot_rests_.size() + edge_rests_.size() &&
         from.edges.size() == edge_values_.size() && from.counts.size() == earlier_.size();
}

void Instant::resume(double t, Recorder* recorder, const Continuation& from, double longest) {
  begin(t, recorder);
  jump_ = from.jump, longest_ = longest;
  auto truth = from.relations.begin();
  for (const GuardGroup& group : plan().guards) {
    if (group.kind == GuardGroup::Kind::crossing) continue;
    for (Index s = 0; s < group.size; ++s) machine_->signal(group.index)[s] = *truth++;
  }
  auto firings = from.firings.begin();
  for (auto* rests : {&slot_rests_, &edge_rests_}) {
    for (Rest& rest : *rests) {
      rest.monitor.load(*firings++);
      if (!rest.monitor.holding) continue;
      ++holds_;
      for (const Index i : rest.states) machine_->rest(i);
    }
  }
  for (std::size_t e = 0; e < edge_values_.size(); ++e)
    edge_values_[e] = static_cast<char>(from.edges[e]);
  earlier_ = from.counts;
  machine_->evaluate_instant(t);
  if (!plan().guards.empty()) machine_->guards(t, machine_->x.data(), g_.data());
  for (std::size_t k = 0; k < watch_->slots.size(); ++k) {
    GuardSlot& slot = watch_->slots[k];
    const Continuation::Guard& saved = from.guards[k];
    slot.side = static_cast<signed char>(saved.side),
    from_[k] = static_cast<signed char>(saved.from);
    slot.fresh = saved.fresh, slot.band = saved.band, slot.base = saved.base;
    resting_[k] = saved.resting;
    watch_->g[k] = g_[k];
  }
  for (std::size_t k : watch_->active) {
    if (SurfaceContact* contact = contact_of(k)) arm_contact(*contact, watch_->slots[k].band);
  }
}

void Instant::log(EventKind kind, int source, int leaf_index, int direction, double predicted,
                  Index entry) {
  ++results_->statistics.events;
  ++outcome_.events;
  last_source_ = source;
  if (kind != EventKind::zeno_enter && kind != EventKind::zeno_release)
    ++counts_[static_cast<std::size_t>(source)];
  if (!options_->record_events) return;
  const PlanLeaf& of = leaf(leaf_index);
  const double* after = x_next_.size() > 0 ? x_next_.data() + of.x : nullptr;
  results_->events.add({t_, event_jump_, direction, kind, source, predicted, 0,
                        static_cast<std::size_t>(of.nx), static_cast<int>(entry)},
                       machine_->x.data() + of.x, after);
}

void Instant::log_monitor(const MonitorHit& hit, const double* x) {
  const auto slot = static_cast<std::size_t>(hit.firing.slot);
  const int group = group_of_slot_[slot];
  ++counts_[static_cast<std::size_t>(group)];
  if (!options_->record_events) return;
  const PlanLeaf& of = leaf(group_of(slot).leaf);
  results_->events.add(
      {hit.t, jump_, -hit.firing.from, EventKind::zero_crossing, group,
       std::numeric_limits<double>::quiet_NaN(), 0, static_cast<std::size_t>(of.nx),
       static_cast<int>(static_cast<Index>(slot) - group_of(slot).slot)},
      x + of.x, x + of.x);
}

std::vector<std::pair<std::string, std::int64_t>> Instant::counts() const {
  std::vector<std::pair<std::string, std::int64_t>> named;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] > 0) named.emplace_back(name_of(static_cast<int>(i)), counts_[i]);
  }
  return named;
}

const std::string& Instant::last_event() const {
  static const std::string none;
  return last_source_ < 0 ? none : name_of(last_source_);
}

/// "block.event" of a source.
const std::string& Instant::name_of(int source) const {
  const auto groups = static_cast<int>(plan().guards.size()),
             edges = static_cast<int>(plan().edges.size());
  if (source < groups) return plan().guards[static_cast<std::size_t>(source)].name;
  if (source < groups + edges) return plan().edges[static_cast<std::size_t>(source - groups)].name;
  return plan().schedule[static_cast<std::size_t>(source - groups - edges)].name;
}

}  // namespace saltus
