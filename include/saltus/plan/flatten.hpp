// Nested diagrams to leaves and nodes: who reads whom, and the shape of every signal.
#pragma once

#include <map>
#include <utility>

#include "saltus/plan/order.hpp"

namespace saltus::detail {

/// The inputs that something reads: those it names, else all.
inline std::vector<int> read_inputs(const std::optional<std::vector<int>>& named,
                                    const PlanLeaf& leaf) {
  if (!named) return leaf.inputs;
  std::vector<int> nodes;
  for (int i : *named) {
    if (i < 0 || i >= static_cast<int>(leaf.inputs.size())) {
      throw ModelError(text("block '", leaf.path, "': a declaration reads input ", i,
                            ", the block has ", leaf.inputs.size()));
    }
    nodes.push_back(leaf.inputs[static_cast<std::size_t>(i)]);
  }
  return nodes;
}

/// Leaves with their places in the flat arrays, and one node for each output and relation.
inline void add_leaves(Plan& plan, const Structure& structure) {
  for (const auto& [system, path] : structure.leaves) {
    const Declarations& d = system->declarations();
    PlanLeaf leaf{.system = system, .path = path};
    leaf.x = plan.nx, leaf.nx = d.continuous.initial.size();
    leaf.z = plan.nz, leaf.nz = d.discrete.size();
    leaf.p = plan.np, leaf.np = d.parameter_values.size();
    plan.nx += leaf.nx, plan.nz += leaf.nz, plan.np += leaf.np;
    const int number = static_cast<int>(plan.leaves.size());
    for (std::size_t i = 0; i < d.outputs.size(); ++i) {
      Node node{.leaf = number,
                .index = static_cast<int>(i),
                .boolean = d.outputs[i].boolean,
                .name = path + "." + d.outputs[i].name};
      node.view = d.outputs[i].view.has_value();
      leaf.outputs.push_back(static_cast<int>(plan.nodes.size()));
      plan.nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; i < d.relations.size(); ++i) {
      leaf.relations.push_back(static_cast<int>(plan.nodes.size()));
      plan.nodes.push_back({.leaf = number,
                            .index = static_cast<int>(i),
                            .relation = true,
                            .boolean = true,
                            .name = path + "." + d.relations[i].name});
    }
    leaf.inputs.assign(d.inputs.size(), -1);
    plan.leaves.push_back(std::move(leaf));
  }
}

/// The node behind every input; an open input of the root is an error.
inline void add_wires(Plan& plan, const Structure& structure) {
  std::map<const LeafSystem*, std::size_t> number;
  for (std::size_t i = 0; i < plan.leaves.size(); ++i) number[plan.leaves[i].system] = i;
  for (const auto& [from, to] : structure.wires) {
    plan.leaves[number.at(to.leaf)].inputs[static_cast<std::size_t>(to.index)] =
        plan.leaves[number.at(from.leaf)].outputs[static_cast<std::size_t>(from.index)];
  }
  for (const PlanLeaf& leaf : plan.leaves) {
    for (std::size_t i = 0; i < leaf.inputs.size(); ++i) {
      if (leaf.inputs[i] < 0) {
        throw ModelError(text("input '", leaf.declared().inputs[i].name, "' of block '", leaf.path,
                              "' is not connected; connect it to a block, for example a Constant"));
      }
    }
  }
}

/// What each node reads when it is computed.
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

/// The shapes of a leaf's inputs, or nothing while one of them is unknown.
inline std::optional<std::vector<Shape>> input_shapes(const Plan& plan, const PlanLeaf& leaf) {
  std::vector<Shape> shapes;
  for (int input : leaf.inputs) {
    if (!plan.node(input).shaped) return std::nullopt;
    shapes.push_back(plan.node(input).shape);
  }
  return shapes;
}

/// Gives a node its shape if what decides it is known.
inline bool shape_node(const Plan& plan, Node& node) {
  const std::optional<Shape> fixed = [&]() -> std::optional<Shape> {
    if (!node.relation) return plan.output_of(node).shape;
    const auto size = plan.relation_of(node).size;
    return size ? std::optional(Shape{*size, *size > 1}) : std::nullopt;
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

/// Shapes spread along the wires until all are known.
inline void add_shapes(Plan& plan) {
  for (bool again = true; again;) {
    again = false;
    for (Node& node : plan.nodes) {
      if (!node.shaped && shape_node(plan, node)) again = true;
    }
  }
  for (Node& node : plan.nodes) {
    if (!node.shaped) {
      Ordering(plan).run();  // an algebraic loop is the likelier cause: it throws with the path
      throw ModelError(text("the width of output '", node.name,
                            "' depends on itself around a loop; put a block of known width, for "
                            "example an Integrator "
                            "with a vector initial_state, into the loop"));
    }
  }
}

/// Every input gets the shape it asked for, and elementwise blocks get equal widths.
inline void check_shapes(const Plan& plan) {
  for (const PlanLeaf& leaf : plan.leaves) {
    for (std::size_t i = 0; i < leaf.inputs.size(); ++i) {
      const Node& source = plan.node(leaf.inputs[i]);
      const InputDeclaration& input = leaf.declared().inputs[i];
      if (input.shape && input.shape->size != source.shape.size) {
        throw ModelError(text("input '", input.name, "' of block '", leaf.path, "': expected ",
                              input.shape->size, " values, found ", source.shape.size,
                              " from output '", source.name, "'"));
      }
    }
  }
}

/// Places: views show a state or parameters; everything else gets room in `y`.
inline void add_places(Plan& plan) {
  for (Node& node : plan.nodes) {
    if (!node.view) {
      node.place = {Space::y, plan.ny, node.shape.size};
      plan.ny += node.shape.size;
      continue;
    }
    const PlanLeaf& leaf = plan.leaf_of(node);
    node.place = *plan.output_of(node).view;
    node.place.offset += node.place.space == Space::x   ? leaf.x
                         : node.place.space == Space::z ? leaf.z
                                                        : leaf.p;
  }
  for (PlanLeaf& leaf : plan.leaves) {
    for (int input : leaf.inputs) leaf.input_places.push_back(plan.node(input).place);
  }
}

/// Leaves, wires and who reads whom.
inline Plan flatten(const System& system) {
  const Structure structure = structure_of(system);
  Plan plan;
  add_leaves(plan, structure);
  add_wires(plan, structure);
  add_needs(plan);
  return plan;
}

/// Shapes and places; after the order, so that an algebraic loop is called that.
inline void lay_out(Plan& plan) {
  add_shapes(plan);
  check_shapes(plan);
  add_places(plan);
}

}  // namespace saltus::detail
