// The plan of one island.
#include <algorithm>

#include "island_blocks.hpp"
#include "saltus/model/computed_parameter.hpp"
#include "saltus/plan/detail/passes.hpp"
#include "saltus/plan/islands.hpp"

namespace saltus {

using namespace detail;

namespace {

/// The number in the part of a node of the whole. The leaves of the part are sorted.
int in_part(const Plan& whole, const Plan& part, const std::vector<int>& leaves, int number) {
  const Node& node = whole.node(number);
  const PlanLeaf& leaf = part.leaf(std::ranges::lower_bound(leaves, node.leaf) - leaves.begin());
  return node.relation ? leaf.relations[node.index] : leaf.outputs[node.index];
}

/// The event wires inside the island, and which of its events other islands get.
void add_event_wires(const Plan& whole, Plan& part, const Islands& islands, std::size_t k) {
  const std::vector<int>& leaves = islands.leaves[k];
  const auto number = [&](int leaf) {
    return static_cast<int>(std::ranges::lower_bound(leaves, leaf) - leaves.begin());
  };
  for (const int i : islands.event_wires[k]) {
    EventWire wire = nth(whole.event_wires.declared, i);
    wire.from = number(wire.from), wire.to = number(wire.to);
    part.event_wires.declared.push_back(wire);
  }
  mark_receivers(part);
  if (!islands.are_wired()) return;
  std::vector<EventWires::Sender>& senders = part.event_wires.senders;
  for (const int i : islands.outgoing[k]) {
    const EventWire& wire = nth(whole.event_wires.declared, i);
    senders.push_back({number(wire.from), wire.event, wire.from_entry});
  }
  std::ranges::sort(senders);
  senders.erase(std::unique(senders.begin(), senders.end()), senders.end());
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    if (whole.leaf(leaves[l]).receives)
      part.leaves[l].receives = part.event_wires.receives_outside = true;
  }
}

/// The diagrams that compute them are in the part.
void add_computed(const Plan& whole, Plan& part, const std::vector<int>& leaves,
                  const std::vector<int>& computed) {
  if (computed.empty()) return;
  const auto moved = [&](Index entry) {
    const int leaf = leaf_of_parameter(whole, entry);
    const auto number = std::ranges::lower_bound(leaves, leaf) - leaves.begin();
    return entry - whole.leaf(leaf).p + part.leaf(number).p;
  };
  auto all = std::make_shared<ComputedParameters>();
  for (const int i : computed) {
    ComputedParameter one = nth(whole.computed->all, i);
    one.to = moved(one.to), one.from = moved(one.from);
    all->all.push_back(std::move(one));
  }
  part.computed = std::move(all);
}

}  // namespace

std::shared_ptr<const Plan> plan_of_island(const Plan& whole, const Islands& islands,
                                           std::size_t k) {
  const std::vector<int>& leaves = islands.leaves[k];
  Structure structure;
  Replacements declarations;
  for (const int i : leaves) {
    structure.leaves.push_back({whole.leaf(i).system, whole.leaf(i).path});
    declarations.push_back(whole.leaf(i).declarations);
  }
  Plan part;
  add_leaves(part, structure, declarations);
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    const List<int>& inputs = whole.leaf(leaves[l]).inputs;
    for (std::size_t input = 0; input < inputs.size(); ++input)
      part.leaves[l].inputs[input] = in_part(whole, part, leaves, inputs[input]);
  }
  if (whole.event_wires.any()) add_event_wires(whole, part, islands, k);
  if (whole.computed) add_computed(whole, part, leaves, islands.computed[k]);
  add_needs(part);
  for (const int tap : islands.taps[k]) {
    const Tap& recorded = nth(whole.taps, tap);
    part.taps.push_back({recorded.name, in_part(whole, part, leaves, recorded.node)});
  }
  const Roots roots = find_shapes_and_rates(part);
  return completed(std::move(part), roots);
}

}  // namespace saltus
