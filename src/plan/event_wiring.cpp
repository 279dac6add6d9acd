// Event wires: found, checked, and sorted by their sources.
#include "saltus/plan/detail/event_wiring.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

namespace saltus::detail {

namespace {

/// Of each leaf: whether it is in a part that is executed as a control signal says.
List<char> controlled_leaves(const Plan& plan, const Structure& structure) {
  List<char> controlled(plan.leaves.size(), 0);
  for (const Structure::Controlled& part : structure.controlled)
    std::fill(controlled.begin() + static_cast<std::ptrdiff_t>(part.first),
              controlled.begin() + static_cast<std::ptrdiff_t>(part.last), char{1});
  return controlled;
}

[[noreturn]] void throw_controlled(const PlanLeaf& leaf) {
  throw ModelError(
      text("block '", leaf.path,
           "': an event wire starts or ends at it, and a control signal executes it; "
           "expected a block outside of every EnabledSubsystem and "
           "TriggeredSubsystem, so keep it out, or let its reset map read the signal"));
}

/// The groups of zero crossings, which come first.
std::span<const GuardGroup> crossings_of(const Plan& plan) {
  const auto end = std::ranges::partition_point(plan.guards, &GuardGroup::is_crossing);
  return {plan.guards.data(), static_cast<std::size_t>(end - plan.guards.begin())};
}

/// The entry of a list in the order of leaves and declarations; the end if there is none.
template <class Range>
auto find_declared(const Range& list, int leaf, int index) {
  const auto place = [](const auto& one) { return std::pair(one.leaf, one.index); };
  const auto found = std::ranges::lower_bound(list, std::pair(leaf, index), {}, place);
  return found != list.end() && place(*found) == std::pair(leaf, index) ? found : list.end();
}

int crossings_declared(const Plan& plan, int leaf) {
  return static_cast<int>(plan.leaf(leaf).declared().zero_crossings.size());
}

}  // namespace

void add_event_wires(Plan& plan, const Structure& structure, const LeafNumbers& numbers) {
  const auto number = [&](const LeafEvent& event) {
    return static_cast<int>(numbers.find(event.leaf).value());
  };
  const List<char> controlled = controlled_leaves(plan, structure);
  plan.event_wires.declared.reserve(structure.event_wires.size());
  for (const Structure::EventWire& wire : structure.event_wires) {
    const int from = number(wire.from), to = number(wire.to);
    for (const int end : {from, to})
      if (controlled[end]) throw_controlled(plan.leaf(end));
    plan.event_wires.declared.push_back({from, wire.from.index, wire.from_entry, to, wire.to.index,
                                         wire.to_entry, wire.weight, wire.delay,
                                         static_cast<int>(plan.event_wires.declared.size())});
  }
  mark_receivers(plan);
}

void mark_receivers(Plan& plan) {
  for (const EventWire& wire : plan.event_wires.declared) plan.leaves[wire.to].receives = true;
}

void place_weight(Plan& plan) {
  plan.event_wires.weight = {Space::y, plan.ny, 1};
  ++plan.ny;
  for (PlanLeaf& leaf : plan.leaves) {
    if (!leaf.receives) continue;
    leaf.delivery_places = leaf.input_places;
    leaf.delivery_places.push_back(plan.event_wires.weight);
  }
}

int event_source_of(const Plan& plan, int leaf, int event, int entry) {
  const int crossings = crossings_declared(plan, leaf);
  if (event >= crossings) {
    const auto found = find_declared(plan.schedule, leaf, event - crossings);
    if (found == plan.schedule.end() || entry != 0) return -1;
    return static_cast<int>(plan.guard_slots + (found - plan.schedule.begin()));
  }
  const auto groups = crossings_of(plan);
  const auto found = find_declared(groups, leaf, event);
  if (found == groups.end() || entry < 0 || entry >= found->size) return -1;
  return static_cast<int>(found->slot) + entry;
}

namespace {

/// The zero crossing of a source that is no time event.
const GuardGroup& group_of(const Plan& plan, int source) {
  const auto groups = crossings_of(plan);
  return *(std::ranges::upper_bound(groups, Index{source}, {}, &GuardGroup::slot) - 1);
}

}  // namespace

EventOrigin event_origin_of(const Plan& plan, int source) {
  if (source >= plan.guard_slots) {
    const ScheduledEvent& event = plan.scheduled(source - plan.guard_slots);
    return {event.leaf, crossings_declared(plan, event.leaf) + event.index, 0};
  }
  const GuardGroup& group = group_of(plan, source);
  return {group.leaf, group.index, source - static_cast<int>(group.slot)};
}

const std::string& event_name(const Plan& plan, int source) {
  if (source < plan.guard_slots) return group_of(plan, source).name;
  return plan.scheduled(source - plan.guard_slots).name;
}

namespace {

/// The wires with a source, by source, then by delay, then in the order of declaration.
struct SortedWire {
  int source, number;
  double delay;
};

std::vector<SortedWire> sorted_wires(const Plan& plan) {
  const auto& declared = plan.event_wires.declared;
  std::vector<SortedWire> sorted;
  sorted.reserve(declared.size());
  for (std::size_t i = 0; i < declared.size(); ++i) {
    const EventWire& wire = declared[i];
    const int source = event_source_of(plan, wire.from, wire.event, wire.from_entry);
    if (source >= 0) sorted.push_back({source, static_cast<int>(i), wire.delay});
  }
  std::ranges::sort(sorted, {}, [](const SortedWire& one) {
    return std::tuple(one.source, one.delay, one.number);
  });
  return sorted;
}

/// Adds a wire as a target of the last batch, or of a new one.
void add_target(EventWires& wires, const SortedWire& one) {
  const auto target = static_cast<int>(wires.targets.size());
  auto& batches = wires.batches;
  if (batches.empty() || batches.back().source != one.source || batches.back().delay != one.delay)
    batches.push_back({one.source, one.delay, target, target});
  const EventWire& wire = nth(wires.declared, one.number);
  wires.targets.push_back({wire.to, wire.input, wire.to_entry, wire.number, wire.weight});
  batches.back().last = target + 1;
}

}  // namespace

namespace {

/// The sources of the wires that lead out of the plan of an island.
void mark_senders(const Plan& plan, EventWires& wires) {
  if (wires.senders.empty()) return;
  wires.sends_outside.assign(static_cast<std::size_t>(plan.guard_slots) + plan.schedule.size(), 0);
  for (const EventWires::Sender& sender : wires.senders) {
    const int source = event_source_of(plan, sender.leaf, sender.event, sender.entry);
    if (source >= 0) wires.sends_outside[source] = 1;
  }
}

}  // namespace

void sort_event_wires(Plan& plan) {
  EventWires& wires = plan.event_wires;
  mark_senders(plan, wires);
  wires.targets.reserve(wires.declared.size());
  for (const SortedWire& one : sorted_wires(plan)) add_target(wires, one);
  const auto sources = static_cast<std::size_t>(plan.guard_slots) + plan.schedule.size();
  wires.first_batch.assign(sources + 1, 0);
  for (const EventWires::Batch& batch : wires.batches) ++wires.first_batch[batch.source + 1];
  std::partial_sum(wires.first_batch.begin(), wires.first_batch.end(), wires.first_batch.begin());
}

}  // namespace saltus::detail
