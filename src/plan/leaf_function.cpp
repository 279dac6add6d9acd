// LeafFunction: the values that one function of a leaf reads, and its exact derivatives by them.
#include "saltus/plan/detail/leaf_function.hpp"

#include <algorithm>

#include "expressions.hpp"
#include "saltus/plan/detail/needs.hpp"
#include "saltus/tape/jacobian.hpp"
#include "saltus/tape/switches.hpp"

namespace saltus {

namespace {

using detail::Expressions, detail::read_inputs, detail::append;

/// The entries of nodes, and those of the leaf itself.
std::vector<ReadValue> reads_of(const Plan& plan, int leaf, const std::vector<int>& nodes) {
  std::vector<ReadValue> all;
  const PlanLeaf& of = plan.leaf(leaf);
  for (Index i = 0; i < of.nx; ++i) all.push_back({Space::x, of.x + i});
  for (Index i = 0; i < of.nz; ++i) all.push_back({Space::z, of.z + i});
  for (Index i = 0; i < of.np; ++i) all.push_back({Space::p, of.p + i});
  for (const int i : nodes) {
    const Node& node = plan.node(i);
    if (node.relation || node.boolean) continue;
    for (Index k = 0; k < node.place.size; ++k)
      all.push_back({node.place.space, node.place.offset + k});
  }
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  return all;
}

tape::Node variable(tape::Graph& graph, const ReadValue& read) {
  if (read.space == Space::x) return graph.continuous_state(read.index);
  if (read.space == Space::z) return graph.input(detail::Expressions::input_of_z, read.index);
  return read.space == Space::p ? graph.parameter(read.index) : graph.discrete_state(read.index);
}

LeafPartials partials_of(const Plan& plan, const LeafFunction& function, const Formula& formula) {
  List<int> first(plan.nodes.size(), Expressions::variable);
  Expressions expressions(plan, first);
  const auto added = expressions.add(formula, function.leaf, function.size);
  std::vector<tape::Node> rows(added.begin(), added.end()), variables;
  tape::Graph& graph = expressions.graph();
  for (const ReadValue& read : function.reads) variables.push_back(variable(graph, read));
  const std::vector<tape::Node> switches = tape::switches_of(graph, rows);
  std::vector<LeafPartials::Entry> entries;
  std::vector<tape::Node> values = rows;
  for (const tape::Partial& one : tape::differentiate(graph, rows, variables)) {
    entries.push_back({one.row, static_cast<std::size_t>(one.column)});
    values.push_back(one.value);
  }
  values.insert(values.end(), switches.begin(), switches.end());
  return {std::move(entries), static_cast<Index>(switches.size()) / tape::numbers_of_switch,
          tape::Tape(graph, values)};
}

LeafFunction made(const Plan& plan, LeafFunction function, const std::vector<int>& nodes,
                  const Formula& formula) {
  function.reads = reads_of(plan, function.leaf, nodes);
  if (formula) function.partials = partials_of(plan, function, formula);
  return function;
}

}  // namespace

LeafFunction function_of_node(const Plan& plan, int number) {
  const Node& node = plan.node(number);
  if (node.relation) {
    const Relation& relation = plan.relation_of(node);
    return made(plan,
                {.name = text("relation '", plan.name_of(node), "'"),
                 .leaf = node.leaf,
                 .size = node.place.size,
                 .call = &relation.guard},
                node.needs, relation.formula);
  }
  const OutputDeclaration& output = plan.output_of(node);
  return made(plan,
              {.name = text("output '", plan.name_of(node), "'"),
               .leaf = node.leaf,
               .size = node.place.size,
               .call = &output.calc,
               .derivatives = &output.derivatives},
              node.needs, output.formula);
}

LeafFunction function_of_rates(const Plan& plan, int leaf) {
  const PlanLeaf& of = plan.leaf(leaf);
  const ContinuousState& state = of.declared().continuous;
  std::vector<int> nodes;
  detail::add_derivative_roots(of, nodes);
  return made(plan,
              {.name = text("the derivative of block '", of.path, "'"),
               .leaf = leaf,
               .size = of.nx,
               .call = state.ode ? &state.ode.function : nullptr,
               .derivatives = &state.derivatives,
               .jacobian = {&state}},
              nodes, state.formula);
}

std::vector<int> nodes_of_guard(const Plan& plan, const GuardGroup& group) {
  const PlanLeaf& leaf = plan.leaf(group.leaf);
  std::vector<int> nodes = read_inputs(plan.crossing_of(group).inputs, leaf);
  append(nodes, leaf.relations);
  return nodes;
}

std::vector<int> nodes_read(const Plan& plan, const GuardGroup& group) {
  return group.is_crossing() ? nodes_of_guard(plan, group) : plan.node(group.index).needs;
}

LeafFunction function_of_guard(const Plan& plan, const GuardGroup& group) {
  const ZeroCrossing& crossing = plan.crossing_of(group);
  return made(plan,
              {.name = text("guard '", group.name, "'"),
               .leaf = group.leaf,
               .size = group.size,
               .call = &crossing.guard,
               .derivatives = &crossing.guard_derivatives},
              nodes_of_guard(plan, group), crossing.formula);
}

}  // namespace saltus
