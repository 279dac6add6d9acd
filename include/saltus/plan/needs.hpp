// Needs: what the derivatives, the guards, the instants and the taps read. Nothing else is ever
// computed.
#pragma once

#include "saltus/plan/flatten.hpp"

namespace saltus::detail {

using Marks = std::vector<char>;

/// Marks nodes and all they read, down to what `stop` says is not computed again.
template <class Stop>
void spread(const Plan& plan, const std::vector<int>& from, Marks& marks, Stop stop) {
  for (int i : from) {
    if (marks[static_cast<std::size_t>(i)]) continue;
    marks[static_cast<std::size_t>(i)] = 1;
    if (!stop(plan.node(i))) spread(plan, plan.node(i).needs, marks, stop);
  }
}

inline void append(std::vector<int>& list, const std::vector<int>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

/// The nodes the odes read.
inline std::vector<int> derivative_roots(const Plan& plan) {
  std::vector<int> roots;
  for (const PlanLeaf& leaf : plan.leaves) {
    const ContinuousState& state = leaf.declared().continuous;
    if (leaf.nx == 0 || !state.ode) continue;
    if (has(state.reads, Reads::inputs)) append(roots, read_inputs(state.inputs, leaf));
    if (has(state.reads, Reads::relations)) append(roots, leaf.relations);
  }
  return roots;
}

/// The nodes the guards of zero crossings read, and the signals watched for edges.
inline std::vector<int> event_roots(const Plan& plan) {
  std::vector<int> roots;
  for (const PlanLeaf& leaf : plan.leaves) {
    for (const ZeroCrossing& crossing : leaf.declared().zero_crossings) {
      if (crossing.direction == Direction::none) continue;
      append(roots, read_inputs(crossing.inputs, leaf));
      append(roots, leaf.relations);
    }
    for (const EdgeReset& reset : leaf.declared().edge_resets)
      append(roots, read_inputs(std::vector{reset.input}, leaf));
  }
  return roots;
}

/// What resets and updates read.
inline std::vector<int> reset_roots(const Plan& plan) {
  std::vector<int> roots;
  for (const PlanLeaf& leaf : plan.leaves) {
    const Declarations& d = leaf.declared();
    const std::size_t before = roots.size();
    for (const auto& crossing : d.zero_crossings) {
      if (crossing.reset_map) append(roots, leaf.inputs);
    }
    for (const auto& reset : d.edge_resets) append(roots, read_inputs(reset.inputs, leaf));
    for (const auto& event : d.time_events) {
      if (event.update) append(roots, read_inputs(event.inputs, leaf));
    }
    if (roots.size() > before || !d.time_events.empty()) append(roots, leaf.relations);
  }
  return roots;
}

/// A relation, or a boolean output we cannot see into, is located when, and only when, it reaches a
/// derivative, a guard or an edge: there its jump would spoil the solver's smooth picture.
inline void find_located(Plan& plan) {
  Marks reached(plan.nodes.size());
  const auto never = [](const Node&) { return false; };
  spread(plan, derivative_roots(plan), reached, never);
  spread(plan, event_roots(plan), reached, never);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (reached[i] && plan.nodes[i].relation) plan.nodes[i].located = true;
    plan.nodes[i].used = reached[i];  // kept for find_rates
  }
}

/// A relation over constant or held values moves at instants only: it is read in order like any
/// output, and is no guard. Before the order is known, so rates are spread until none changes.
inline void release_held_relations(Plan& plan) {
  std::vector<Rate> own(plan.nodes.size(), Rate::constant);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
      const Node& node = plan.nodes[i];
      const PlanLeaf& leaf = plan.leaf_of(node);
      const Reads reads = node.relation ? plan.relation_of(node).reads : plan.output_of(node).reads;
      Rate rate = own_rate(reads, leaf.nx > 0, leaf.nz > 0, leaf.declared().has_modes);
      for (int need : node.needs) {
        const bool stepwise =
            plan.node(need).located || (plan.node(need).boolean && plan.node(need).used);
        const Rate seen = own[static_cast<std::size_t>(need)];
        rate = faster(rate, stepwise ? std::min(seen, Rate::held) : seen);
      }
      again = again || rate != own[i];
      own[i] = rate;
    }
  }
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (plan.nodes[i].relation && own[i] != Rate::continuous) plan.nodes[i].located = false;
  }
}

/// Rates spread along the order; a reached boolean that would be continuous is an opaque one,
/// located and held.
inline void find_rates(Plan& plan) {
  for (int i : plan.order) {
    Node& node = plan.nodes[static_cast<std::size_t>(i)];
    const PlanLeaf& leaf = plan.leaf_of(node);
    const Reads reads = node.relation ? plan.relation_of(node).reads : plan.output_of(node).reads;
    node.rate = own_rate(reads, leaf.nx > 0, leaf.nz > 0, leaf.declared().has_modes);
    for (int need : node.needs) node.rate = faster(node.rate, plan.node(need).rate);
    if (!node.relation && node.boolean && node.used && node.rate == Rate::continuous)
      node.located = true;
    if (node.located) node.rate = Rate::held;  // what it reads may stand behind it in the order
  }
}

/// What has to be computed for `roots`, in order: the nodes of one rate.
inline std::vector<int> slice(const Plan& plan, const Marks& marks, Rate rate) {
  std::vector<int> list;
  for (int i : plan.order) {
    const Node& node = plan.node(i);
    if (marks[static_cast<std::size_t>(i)] && node.rate == rate && !node.view && !node.located)
      list.push_back(i);
  }
  return list;
}

/// The inputs behind located relations and opaque booleans: what their guards read.
inline std::vector<int> located_needs(const Plan& plan) {
  std::vector<int> roots;
  for (const Node& node : plan.nodes) {
    if (node.located) append(roots, node.needs);
  }
  return roots;
}

/// The lists of the plan.
inline void find_slices(Plan& plan) {
  const auto held = [](const Node& node) { return node.rate != Rate::continuous; };
  const auto never = [](const Node&) { return false; };
  const auto marked = [&](const std::vector<int>& roots, auto stop) {
    Marks marks(plan.nodes.size());
    spread(plan, roots, marks, stop);
    return marks;
  };
  std::vector<int> guards = event_roots(plan), taps;
  append(guards, located_needs(plan));
  for (const Tap& tap : plan.taps) taps.push_back(tap.node);

  plan.derivatives = slice(plan, marked(derivative_roots(plan), held), Rate::continuous);
  plan.guard_needs = slice(plan, marked(guards, held), Rate::continuous);
  plan.tap_needs = slice(plan, marked(taps, held), Rate::continuous);

  std::vector<int> all = derivative_roots(plan);
  for (const auto& more : {guards, taps, reset_roots(plan)}) append(all, more);
  const Marks used = marked(all, never);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) plan.nodes[i].used = used[i];
  plan.constants = slice(plan, used, Rate::constant);

  Marks instants = marked(reset_roots(plan), held);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (used[i] && plan.nodes[i].rate == Rate::held)
      spread(plan, {static_cast<int>(i)}, instants, never);
  }
  for (int i : plan.order) {
    const Node& node = plan.node(i);
    if (instants[static_cast<std::size_t>(i)] && node.rate != Rate::constant && !node.view &&
        !node.located) {
      plan.instants.push_back(i);
    }
  }
  const Marks moving = marked(derivative_roots(plan), held);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (moving[i] && plan.nodes[i].rate == Rate::held)
      plan.restarting.push_back(static_cast<int>(i));
  }
}

}  // namespace saltus::detail
