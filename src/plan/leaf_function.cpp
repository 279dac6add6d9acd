// LeafFunction: the values that one function of a leaf reads, and its exact derivatives by them.
#include "saltus/plan/detail/leaf_function.hpp"

#include <algorithm>

#include "expressions.hpp"
#include "saltus/plan/detail/needs.hpp"
#include "saltus/tape/jacobian.hpp"

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

/// The switches of some expressions: see LeafPartials.
class Switches {
 public:
  explicit Switches(tape::Graph& graph) : graph_(graph) {}

  std::vector<tape::Node> of(std::span<const tape::Node> rows) {
    std::vector<char> seen(static_cast<std::size_t>(graph_.size()), 0);
    std::vector<tape::Node> open(rows.begin(), rows.end());
    while (!open.empty()) {
      const tape::Node node = open.back();
      open.pop_back();
      if (std::exchange(nth(seen, node.id), char{1})) continue;
      const tape::Expression of = graph_[node];  // a copy: `look` adds nodes
      look(of);
      open.insert(open.end(), of.operands.begin(), of.operands.begin() + operand_count(of.op));
    }
    return std::move(found_);
  }

 private:
  using Op = tape::Op;

  void look(const tape::Expression& of) {
    const auto& [a, b, c] = of.operands;
    switch (of.op) {
      case Op::lt:
      case Op::le:
      case Op::gt:
      case Op::ge:
      case Op::eq:
      case Op::ne:
      case Op::minimum:
      case Op::maximum:
        return add(a, b);
      case Op::abs:
      case Op::sign:
        return add(a, zero());
      case Op::copysign:
        return add(a, zero()), add(b, zero());
      case Op::hypot:
        return add(graph_.binary(Op::hypot, a, b), zero());
      case Op::floor:
      case Op::ceil:
      case Op::trunc:
        return add(a, graph_.unary(Op::rint, a));
      case Op::rint:  // its jumps are between the whole numbers
        return add(graph_.unary(Op::abs, graph_.binary(Op::sub, a, graph_.unary(Op::rint, a))),
                   graph_.constant(0.5));
      case Op::mod:
      case Op::fmod:
      case Op::floor_divide: {
        const tape::Node quotient = graph_.binary(Op::div, a, b);
        return add(quotient, graph_.unary(Op::rint, quotient));
      }
      default:
        return;
    }
  }
  tape::Node zero() { return graph_.constant(0.0); }
  void add(tape::Node a, tape::Node b) {
    found_.insert(found_.end(), {a, b, graph_.binary(Op::add, terms(a), terms(b))});
  }
  tape::Node terms(tape::Node a) {
    const tape::Expression of = graph_[a];
    const bool sum = of.op == Op::sub || of.op == Op::add;
    const auto size = [&](tape::Node node) { return graph_.unary(Op::abs, node); };
    return sum ? graph_.binary(Op::add, size(of.operands[0]), size(of.operands[1])) : size(a);
  }

  tape::Graph& graph_;
  std::vector<tape::Node> found_;
};

LeafPartials partials_of(const Plan& plan, const LeafFunction& function, const Formula& formula) {
  List<int> first(plan.nodes.size(), Expressions::variable);
  Expressions expressions(plan, first);
  const auto added = expressions.add(formula, function.leaf, function.size);
  std::vector<tape::Node> rows(added.begin(), added.end()), variables;
  tape::Graph& graph = expressions.graph();
  for (const ReadValue& read : function.reads) variables.push_back(variable(graph, read));
  const std::vector<tape::Node> switches = Switches(graph).of(rows);
  std::vector<LeafPartials::Entry> entries;
  std::vector<tape::Node> values = rows;
  for (const tape::Partial& one : tape::differentiate(graph, rows, variables)) {
    entries.push_back({one.row, static_cast<std::size_t>(one.column)});
    values.push_back(one.value);
  }
  values.insert(values.end(), switches.begin(), switches.end());
  return {std::move(entries), static_cast<Index>(switches.size()) / LeafPartials::numbers_of_switch,
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
