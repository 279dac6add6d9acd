// Needs: the values that the derivatives, the guards, the instants and the taps read. Nothing else
// is ever computed.
#pragma once

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/flatten.hpp"

namespace saltus::detail {

using Marks = List<char>;

/// Marks nodes and everything they read. It does not go beyond a node for which `stop` is true,
/// because that node is not computed again.
template <class Stop>
void spread(const Plan& plan, const std::vector<int>& from, Marks& marks, Stop stop) {
  std::vector<int> open;
  const auto mark = [&](const std::vector<int>& nodes) {
    for (int i : nodes) {
      if (!std::exchange(marks[i], 1)) open.push_back(i);
    }
  };
  mark(from);
  while (!open.empty()) {
    const Node& node = plan.node(open.back());
    open.pop_back();
    if (!stop(node)) mark(node.needs);
  }
}

inline void append(std::vector<int>& list, const std::vector<int>& more) {
  list.insert(list.end(), more.begin(), more.end());
}
inline void append_inputs(std::vector<int>& list, const std::optional<std::vector<int>>& named,
                          const PlanLeaf& leaf) {
  append(list, named ? read_inputs(named, leaf) : leaf.inputs);
}

/// The nodes that the functions of the leaves read. One walk finds all of them, because it visits
/// every declaration of a large diagram, which is more than a cache holds.
struct Roots {
  std::vector<int> derivatives;  // odes
  std::vector<int> events;       // guards of zero crossings; signals watched for edges
  std::vector<int> resets;       // reset maps and updates
  std::vector<int> histories;    // inputs whose history a leaf keeps
};

inline void add_derivative_roots(const PlanLeaf& leaf, std::vector<int>& roots) {
  const ContinuousState& state = leaf.declared().continuous;
  if (leaf.nx == 0 || !state.ode) return;
  if (has(state.reads, Reads::inputs)) append_inputs(roots, state.inputs, leaf);
  if (has(state.reads, Reads::relations)) append(roots, leaf.relations);
}

inline void add_event_roots(const PlanLeaf& leaf, std::vector<int>& roots) {
  for (const ZeroCrossing& crossing : leaf.declared().zero_crossings) {
    if (crossing.direction == Direction::none) continue;
    append_inputs(roots, crossing.inputs, leaf);
    append(roots, leaf.relations);
  }
  for (const EdgeReset& reset : leaf.declared().edge_resets)
    append(roots, read_inputs(std::vector{reset.input}, leaf));
  append(roots, read_inputs(leaf.declared().controls, leaf));
}

inline bool is_function(const std::optional<NumberOf>& number) {
  return number && !number->is_constant();
}

/// Whether a firing of the crossing calls a function of the block.
inline bool calls_at_firing(const ZeroCrossing& crossing) {
  return crossing.reset_map || is_function(crossing.delay) || is_function(crossing.priority);
}

inline void add_reset_roots(const PlanLeaf& leaf, std::vector<int>& roots) {
  const Declarations& d = leaf.declared();
  const std::size_t before = roots.size();
  for (const auto& crossing : d.zero_crossings)
    if (calls_at_firing(crossing)) append(roots, leaf.inputs);
  for (const auto& reset : d.edge_resets) append_inputs(roots, reset.inputs, leaf);
  for (const auto& event : d.time_events) {
    if (event.update) append_inputs(roots, event.inputs, leaf);
  }
  if (leaf.receives) {
    for (const auto& input : d.event_inputs) append_inputs(roots, input.inputs, leaf);
  }
  if (roots.size() > before || leaf.receives || !d.time_events.empty())
    append(roots, leaf.relations);
}

inline void add_history_roots(const PlanLeaf& leaf, std::vector<int>& roots) {
  for (const History& history : leaf.declared().histories)
    append(roots, read_inputs(std::vector{history.input}, leaf));
}

inline Roots find_roots(const Plan& plan) {
  Roots roots;
  for (const PlanLeaf& leaf : plan.leaves) {
    add_derivative_roots(leaf, roots.derivatives);
    add_event_roots(leaf, roots.events);
    add_reset_roots(leaf, roots.resets);
    add_history_roots(leaf, roots.histories);
  }
  return roots;
}

/// The kinds of values that a node reads itself.
inline Reads reads_of(const Plan& plan, const Node& node) {
  return node.relation ? plan.relation_of(node).reads : plan.output_of(node).reads;
}

/// A relation, or an opaque boolean output, is located if and only if it reaches a derivative, a
/// guard, an edge or a history: its jump there would break the smoothness that the solver, or the
/// polynomial of a history, assumes. A value that samples the boolean is held, and hides the jump.
inline void find_located(Plan& plan, const Roots& roots) {
  Marks reached(plan.nodes.size());
  const auto sampled = [&](const Node& node) { return samples(reads_of(plan, node)); };
  spread(plan, roots.derivatives, reached, sampled);
  spread(plan, roots.events, reached, sampled);
  spread(plan, roots.histories, reached, sampled);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (reached[i] && plan.nodes[i].relation) plan.nodes[i].located = true;
    plan.nodes[i].used = reached[i];  // kept for find_rates
  }
}

/// The rate of a node by the values it reads itself.
inline Rate own_rate(const Plan& plan, const Node& node) {
  const PlanLeaf& leaf = plan.leaf_of(node);
  return own_rate(reads_of(plan, node), leaf.nx > 0, leaf.nz > 0, leaf.declared().has_modes);
}

/// The rates of all nodes before their order is known. A node whose rate rises raises its readers;
/// no rate rises more than twice.
inline List<Rate> spread_rates(const Plan& plan) {
  std::vector<std::pair<int, int>> reads;
  List<Rate> rates;
  std::vector<int> risen(plan.nodes.size());
  std::iota(risen.begin(), risen.end(), 0);
  for (const int i : risen) {
    rates.push_back(own_rate(plan, plan.node(i)));
    if (samples(reads_of(plan, plan.node(i)))) continue;  // sampled values do not raise it
    for (const int need : plan.node(i).needs) reads.emplace_back(need, i);
  }
  const Lists readers(plan.nodes.size(), reads);
  while (!risen.empty()) {
    const int i = risen.back();
    risen.pop_back();
    const Node& node = plan.node(i);
    const bool stepwise = node.located || (node.boolean && node.used);
    const Rate own = rates[i], seen = stepwise ? std::min(own, Rate::held) : own;
    for (const int reader : readers[i]) {
      Rate& rate = rates[reader];
      if (seen <= rate) continue;
      rate = seen;
      risen.push_back(reader);
    }
  }
  return rates;
}

/// A relation over constant or held values changes at instants only. It is evaluated in order, like
/// any output, and is no guard.
inline void release_held_relations(Plan& plan) {
  const bool any = std::ranges::any_of(plan.nodes, &Node::relation);
  const List<Rate> rates = any ? spread_rates(plan) : List<Rate>();
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (plan.nodes[i].relation && rates[i] != Rate::continuous) plan.nodes[i].located = false;
  }
}

/// Spreads rates along the order. A reached boolean that would be continuous is opaque, so it is
/// located and held.
inline void find_rates(Plan& plan) {
  for (int i : plan.order) {
    Node& node = plan.nodes[i];
    node.rate = own_rate(plan, node);
    if (!samples(reads_of(plan, node)))
      for (int need : node.needs) node.rate = faster(node.rate, plan.node(need).rate);
    if (!node.relation && node.boolean && node.used && node.rate == Rate::continuous)
      node.located = true;
    if (node.located) node.rate = Rate::held;  // the nodes it reads may come later in the order
  }
}

/// The nodes of one rate that `roots` needs, in order.
inline std::vector<int> slice(const Plan& plan, const Marks& marks, Rate rate) {
  std::vector<int> list;
  for (int i : plan.order) {
    const Node& node = plan.node(i);
    if (marks[i] && node.rate == rate && !node.view && !node.located) list.push_back(i);
  }
  return list;
}

/// The inputs of located relations and opaque booleans, which their guards read.
inline std::vector<int> located_needs(const Plan& plan) {
  std::vector<int> roots;
  for (const Node& node : plan.nodes) {
    if (node.located) append(roots, node.needs);
  }
  return roots;
}

/// The held nodes among the marked ones.
inline std::vector<int> held_of(const Plan& plan, const Marks& marks) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (marks[i] && plan.nodes[i].rate == Rate::held) nodes.push_back(static_cast<int>(i));
  }
  return nodes;
}

/// Fills the lists of the plan.
inline void find_slices(Plan& plan, const Roots& roots) {
  const auto held = [](const Node& node) { return node.rate != Rate::continuous; };
  const auto never = [](const Node&) { return false; };
  const auto marked = [&](const std::vector<int>& from, auto stop) {
    Marks marks(plan.nodes.size());
    spread(plan, from, marks, stop);
    return marks;
  };
  std::vector<int> guards = roots.events, taps;
  append(guards, located_needs(plan));
  for (const Tap& tap : plan.taps) taps.push_back(tap.node);

  const Marks moving = marked(roots.derivatives, held);
  plan.needs.derivatives = slice(plan, moving, Rate::continuous);
  plan.needs.guards = slice(plan, marked(guards, held), Rate::continuous);
  plan.needs.taps = slice(plan, marked(taps, held), Rate::continuous);
  plan.needs.histories = slice(plan, marked(roots.histories, held), Rate::continuous);

  std::vector<int> all = roots.derivatives;
  append(all, guards), append(all, taps), append(all, roots.resets), append(all, roots.histories);
  const Marks used = marked(all, never);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) plan.nodes[i].used = used[i];
  plan.needs.constants = slice(plan, used, Rate::constant);

  Marks instants = marked(roots.resets, held);
  spread(plan, held_of(plan, used), instants, never);
  for (int i : plan.order) {
    const Node& node = plan.node(i);
    if (instants[i] && node.rate != Rate::constant && !node.view && !node.located) {
      plan.needs.instants.push_back(i);
    }
  }
  plan.needs.restarting = held_of(plan, moving);
}

}  // namespace saltus::detail
