// Resolves nested diagrams to leaves and nodes: the readers and the shape of every signal.
#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "saltus/base/list.hpp"
#include "saltus/model/computed_parameter.hpp"
#include "saltus/model/detail/shape_guess.hpp"
#include "saltus/plan/detail/controls.hpp"
#include "saltus/plan/detail/event_wiring.hpp"
#include "saltus/plan/detail/lists.hpp"
#include "saltus/plan/detail/order.hpp"

namespace saltus::detail {

/// The inputs that a computation reads: the inputs that it names, or all if it names none.
inline List<int> read_inputs(const std::optional<std::vector<int>>& named, const PlanLeaf& leaf) {
  if (!named) return leaf.inputs;
  List<int> nodes;
  for (int i : *named) {
    if (i < 0 || i >= static_cast<int>(leaf.inputs.size())) {
      throw ModelError(text("block '", leaf.path, "': a declaration reads input ", i,
                            ", the block has ", leaf.inputs.size()));
    }
    nodes.push_back(leaf.inputs[i]);
  }
  return nodes;
}

/// Adds one node for each output and each relation of a leaf, as the last nodes of the plan.
inline void add_nodes(Plan& plan, PlanLeaf& leaf) {
  const Declarations& d = leaf.declared();
  const int number = static_cast<int>(plan.leaves.size());
  const auto outputs = static_cast<int>(d.outputs.size());
  leaf.outputs.resize(d.outputs.size()), leaf.relations.resize(d.relations.size());
  std::iota(leaf.outputs.begin(), leaf.outputs.end(), static_cast<int>(plan.nodes.size()));
  std::iota(leaf.relations.begin(), leaf.relations.end(),
            static_cast<int>(plan.nodes.size()) + outputs);
  for (int i = 0; i < outputs; ++i) {
    const OutputDeclaration& output = d.outputs[i];
    plan.nodes.push_back(
        {.leaf = number, .index = i, .boolean = output.boolean, .view = output.view.has_value()});
  }
  for (int i = 0; i < static_cast<int>(d.relations.size()); ++i)
    plan.nodes.push_back({.leaf = number, .index = i, .relation = true, .boolean = true});
}

/// Declarations that replace those of the leaves, by number of the leaf. Where the entry is null or
/// missing, the leaf keeps its own.
using Replacements = std::vector<std::shared_ptr<const Declarations>>;

/// The declarations of a leaf in the plan. If they are the leaf's own, the plan marks them as in
/// use but does not own them.
inline std::shared_ptr<const Declarations> declarations_of(const LeafSystem& leaf,
                                                           std::size_t number,
                                                           const Replacements& replacements) {
  if (number < replacements.size() && replacements[number]) return replacements[number];
  return {leaf.declarations().use, &leaf.declarations()};
}

/// Adds the leaves, with their places in the flat arrays, and their nodes.
inline void add_leaves(Plan& plan, Structure& structure, const Replacements& replacements) {
  plan.leaves.reserve(structure.leaves.size());  // so no leaf is moved, and few nodes are
  plan.nodes.reserve(structure.leaves.size());
  for (auto& [system, path] : structure.leaves) {
    PlanLeaf leaf{.system = system,
                  .path = std::move(path),
                  .declarations = declarations_of(*system, plan.leaves.size(), replacements)};
    const Declarations& d = leaf.declared();
    leaf.x = plan.nx, leaf.nx = d.continuous.initial.size();
    leaf.z = plan.nz, leaf.nz = d.discrete.size();
    leaf.p = plan.np, leaf.np = d.parameter_values.size();
    plan.nx += leaf.nx, plan.nz += leaf.nz, plan.np += leaf.np;
    add_nodes(plan, leaf);
    leaf.inputs.assign(d.inputs.size(), -1);
    plan.leaves.push_back(std::move(leaf));
  }
}

/// Finds the node that feeds each input; an open input of the root is an error.
inline void add_wires(Plan& plan, const Structure& structure, const LeafNumbers& numbers) {
  for (const auto& [from, to] : structure.wires) {
    plan.leaves[numbers.find(to.leaf).value()].inputs[to.index] =
        plan.leaves[numbers.find(from.leaf).value()].outputs[from.index];
  }
  if (!structure.fixed.empty()) add_fixed_inputs(plan, structure, numbers);
  for (const PlanLeaf& leaf : plan.leaves) {
    for (std::size_t i = 0; i < leaf.inputs.size(); ++i) {
      if (leaf.inputs[i] < 0) {
        throw InputNotConnectedError(
            text("input '", leaf.declared().inputs[i].name, "' of block '", leaf.path,
                 "' is not connected; connect it to a block, for example a Constant"));
      }
    }
  }
}

/// Finds the nodes that each node reads when it is computed.
inline void add_needs(Plan& plan) {
  for (Node& node : plan.nodes) {
    if (node.view) continue;
    const PlanLeaf& leaf = plan.leaf_of(node);
    if (node.relation) {
      const Relation& relation = plan.relation_of(node);
      if (has(relation.reads, Reads::inputs)) node.needs = read_inputs(relation.inputs, leaf);
      continue;
    }
    const OutputDeclaration& output = plan.output_of(node);
    if (has(output.reads, Reads::inputs)) node.needs = read_inputs(output.inputs, leaf);
    if (has(output.reads, Reads::relations)) {
      node.needs.insert(node.needs.end(), leaf.relations.begin(), leaf.relations.end());
    }
  }
}

/// The shapes of a leaf's inputs, or nothing while the shape of an input is unknown.
inline std::optional<std::vector<Shape>> input_shapes(const Plan& plan, const PlanLeaf& leaf) {
  std::vector<Shape> shapes;
  for (int input : leaf.inputs) {
    if (!plan.node(input).shaped) return std::nullopt;
    shapes.push_back(plan.node(input).shape);
  }
  return shapes;
}

/// Sets the shape of a node if everything that decides it is known.
inline bool shape_node(const Plan& plan, Node& node) {
  const std::optional<Shape> fixed = [&]() -> std::optional<Shape> {
    if (!node.relation) return plan.output_of(node).shape;
    const auto size = plan.relation_of(node).size;
    return size ? std::optional(Shape{*size, *size > 1, 0}) : std::nullopt;
  }();
  const auto inputs =
      fixed ? std::optional<std::vector<Shape>>() : input_shapes(plan, plan.leaf_of(node));
  if (!fixed && !inputs) return false;
  node.shape = fixed ? *fixed
               : !node.relation && plan.output_of(node).shape_rule
                   ? plan.output_of(node).shape_rule(*inputs)
                   : elementwise(*inputs);
  return node.shaped = true;
}

/// Sets all shapes that can be known: of all nodes in turn, then of the nodes of each leaf whose
/// last unknown input became known. Each wire is followed once.
class Shaping {
 public:
  explicit Shaping(Plan& plan) : plan_(plan) {
    std::vector<std::pair<int, int>> wires;  // from a node to a leaf that reads it
    for (std::size_t l = 0; l < plan.leaves.size(); ++l)
      for (const int input : plan.leaves[l].inputs) wires.emplace_back(input, static_cast<int>(l));
    readers_ = Lists(plan.nodes.size(), wires);
    for (const PlanLeaf& leaf : plan.leaves)
      unknown_.push_back(static_cast<int>(leaf.inputs.size()));
  }

  void run() {
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) shape(static_cast<int>(i));
    while (!known_.empty()) {
      const int node = known_.back();
      known_.pop_back();
      for (const int leaf : readers_[node]) {
        if (--unknown_[leaf] > 0) continue;
        for (const int output : plan_.leaves[leaf].outputs) shape(output);
        for (const int relation : plan_.leaves[leaf].relations) shape(relation);
      }
    }
  }

 private:
  void shape(int i) {
    Node& node = plan_.nodes[i];
    if (!node.shaped && shape_node(plan_, node)) known_.push_back(i);
  }

  Plan& plan_;
  Lists readers_;
  List<int> unknown_;       // number of inputs of each leaf whose shape is unknown
  std::vector<int> known_;  // nodes whose readers do not know the shape yet
};

/// Spreads shapes along the wires until all are known.
inline void add_shapes(Plan& plan) {
  Shaping(plan).run();
  for (Node& node : plan.nodes) {
    if (!node.shaped) {
      order_of(plan);  // more often the cause is an algebraic loop: this throws with its path
      throw ModelError(text("the width of output '", plan.name_of(node),
                            "' depends on itself around a loop; put a block of known width, for "
                            "example an Integrator "
                            "with a vector initial_state, into the loop"));
    }
  }
}

/// Checks that every input gets the shape it asked for.
inline void check_shapes(const Plan& plan) {
  for (const PlanLeaf& leaf : plan.leaves) {
    for (std::size_t i = 0; i < leaf.inputs.size(); ++i) {
      const Node& source = plan.node(leaf.inputs[i]);
      const InputDeclaration& input = leaf.declared().inputs[i];
      if (!input.takes(source.shape)) {
        const bool fixed = is_fixed(plan, source);
        throw_wrong_shape(input.name, leaf.path, *input.shape, source.shape,
                          fixed ? "its fixed value" : text("output '", plan.name_of(source), "'"));
      }
    }
  }
}

/// Assigns places: views show a state or parameters; every other value gets a place in `y`.
inline void add_places(Plan& plan) {
  for (Node& node : plan.nodes) {
    if (!node.view) {
      node.place = {Space::y, plan.ny, node.shape.size, node.shape.columns};
      plan.ny += node.shape.size;
      continue;
    }
    const PlanLeaf& leaf = plan.leaf_of(node);
    node.place = *plan.output_of(node).view;
    node.place.columns = static_cast<int>(node.shape.columns);
    node.place.offset += node.place.space == Space::x   ? leaf.x
                         : node.place.space == Space::z ? leaf.z
                                                        : leaf.p;
  }
  for (PlanLeaf& leaf : plan.leaves) {
    leaf.input_places.reserve(leaf.inputs.size());
    for (int input : leaf.inputs) leaf.input_places.push_back(plan.node(input).place);
  }
}

/// Finds leaves, wires and readers.
inline Plan flatten(const System& system, const Replacements& replacements = {}) {
  Structure structure = structure_of(system);
  Plan plan;
  plan.computed = computed_parameters(structure);  // before the paths of the leaves are moved away
  add_leaves(plan, structure, replacements);
  const LeafNumbers numbers(plan);
  add_wires(plan, structure, numbers);
  if (!structure.controlled.empty()) add_controls(plan, structure, numbers);
  if (!structure.event_wires.empty()) add_event_wires(plan, structure, numbers);
  add_needs(plan);
  return plan;
}

/// Adds to an error about shapes which function threw when it was called for the shape of an output:
/// the shape that counted for it may be what does not fit.
inline void explain_shapes(const Plan& plan, ModelError& error) {
  for (const Node& node : plan.nodes) {
    if (node.relation || !plan.output_of(node).shape_rule) continue;
    std::vector<Shape> inputs;
    for (const int input : plan.leaf_of(node).inputs)
      inputs.push_back(plan.node(input).shaped ? plan.node(input).shape : Shape{0, false});
    if (explain_by_guess(error, [&] { plan.output_of(node).shape_rule(inputs); })) return;
  }
}

/// Finds shapes and places. It runs after the order is known, so that an algebraic loop is reported
/// as a loop.
inline void lay_out(Plan& plan) {
  try {
    add_shapes(plan);
    check_shapes(plan);
  } catch (ModelError& error) {
    explain_shapes(plan, error);
    throw;
  }
  add_places(plan);
  if (plan.event_wires.any()) place_weight(plan);
}

}  // namespace saltus::detail
