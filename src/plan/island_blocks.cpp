// Which blocks of a plan have states or events, count for its islands, or are copied into them.
#include "island_blocks.hpp"

#include <algorithm>
#include <utility>

#include "saltus/model/computed_parameter.hpp"

namespace saltus::detail {

namespace {

bool has_state_or_event(const PlanLeaf& leaf) {
  const Declarations& d = leaf.declared();
  return leaf.nx > 0 || leaf.nz > 0 || d.has_modes || !d.zero_crossings.empty() ||
         !d.edge_resets.empty() || !d.time_events.empty() || !d.histories.empty() ||
         !d.relations.empty();
}

/// A source whose events are time events: equal in each copy, because it reads nothing.
bool is_scheduled(const PlanLeaf& leaf) {
  const Declarations& d = leaf.declared();
  return leaf.inputs.empty() && leaf.nx == 0 && d.zero_crossings.empty() && d.edge_resets.empty() &&
         d.histories.empty();
}

/// The nodes that are read or recorded.
List<char> read_nodes(const Plan& plan) {
  List<char> read(plan.nodes.size(), 0);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) read[i] = plan.node(i).used;
  for (const Tap& tap : plan.taps) read[tap.node] = 1;
  return read;
}

void mark_located(const Plan& plan, List<char>& leaves) {
  for (const Node& node : plan.nodes)
    if (node.located) leaves[node.leaf] = 1;
}

/// The blocks at both ends of the event wires.
void mark_wired(const Plan& plan, List<char>& leaves) {
  for (const EventWire& wire : plan.event_wires.declared) leaves[wire.from] = leaves[wire.to] = 1;
}

List<char> live_leaves(const Plan& plan) {
  List<char> live(plan.leaves.size(), 0);
  for (std::size_t i = 0; i < plan.leaves.size(); ++i) live[i] = has_state_or_event(plan.leaf(i));
  mark_located(plan, live);
  mark_wired(plan, live);
  return live;
}

/// The live leaves that join their readers: a located relation is found by each solver in its own
/// steps, and an event wire leads to one block, not to its copies.
List<char> joining_leaves(const Plan& plan, const List<char>& live) {
  List<char> joining = live;
  for (std::size_t i = 0; i < plan.leaves.size(); ++i)
    if (is_scheduled(plan.leaf(i))) joining[i] = 0;
  mark_located(plan, joining);
  mark_wired(plan, joining);
  return joining;
}

/// The leaves that are live, that have a read output, or that feed an input of such a leaf.
List<char> active_leaves(const Plan& plan, const List<char>& read, const List<char>& live) {
  List<char> active = live;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i)
    if (read[i]) active[plan.node(i).leaf] = 1;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) open.push_back(i);
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for (const int input : plan.leaf(i).inputs) {
      const auto source = static_cast<std::size_t>(plan.node(input).leaf);
      if (!std::exchange(active[source], 1)) open.push_back(source);
    }
  }
  return active;
}

/// A loop is not copied.
class Copies {
 public:
  Copies(const Plan& plan, List<char> joining)
      : plan_(plan),
        joining_(std::move(joining)),
        copied_(plan.leaves.size(), 0),
        state_(plan.leaves.size(), 0) {
    for (int first = 0; first < std::ssize(plan.leaves); ++first) visit(first);
  }

  List<char> take() { return std::move(copied_); }

 private:
  void visit(int first) {
    std::vector<int> open{first};
    while (!open.empty()) {
      const int i = open.back();
      if (state_[i] == 2 || joining_[i]) {
        state_[i] = 2, open.pop_back();
        continue;
      }
      const std::vector<int> sources = sources_of(plan_, i);
      if (std::exchange(state_[i], 1) == 0) {
        for (const int source : sources)
          if (state_[source] == 0) open.push_back(source);
        continue;
      }
      state_[i] = 2, open.pop_back();
      copied_[i] = std::ranges::all_of(sources, [&](int s) { return copied_[s] != 0; });
    }
  }

  const Plan& plan_;
  List<char> joining_;
  List<char> copied_;
  List<int> state_;  // 0: not seen, 1: under way, 2: known
};

}  // namespace

IslandBlocks::IslandBlocks(const Plan& plan)
    : read(read_nodes(plan)),
      live(live_leaves(plan)),
      active(active_leaves(plan, read, live)),
      copied(Copies(plan, joining_leaves(plan, live)).take()) {}

std::vector<int> sources_of(const Plan& plan, int leaf) {
  std::vector<int> leaves;
  for (const int input : plan.leaf(leaf).inputs) {
    if (plan.node(input).leaf != leaf) leaves.push_back(plan.node(input).leaf);
  }
  std::ranges::sort(leaves);
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

int leaf_of_parameter(const Plan& plan, Index entry) {
  const auto after = std::ranges::upper_bound(plan.leaves, entry, {}, &PlanLeaf::p);
  return static_cast<int>(after - plan.leaves.begin()) - 1;
}

List<std::vector<int>> computed_by_leaf(const Plan& plan) {
  List<std::vector<int>> of(plan.leaves.size());
  if (!plan.computed) return of;
  const auto& all = plan.computed->all;
  for (int i = 0; i < std::ssize(all); ++i) of[leaf_of_parameter(plan, all[i].to)].push_back(i);
  return of;
}

}  // namespace saltus::detail
