// Stepwise: a formula is searched for operations that have steps.
#include "stepwise.hpp"

#include <algorithm>

#include "expressions.hpp"
#include "fusible.hpp"

namespace saltus::detail {

namespace {

using tape::Op;

/// The operations whose value may be constant where no operand is. No comparison is among them.
constexpr Op stepped[] = {Op::floor,        Op::ceil,    Op::trunc,   Op::rint,  Op::sign,
                          Op::floor_divide, Op::minimum, Op::maximum, Op::select};

bool is_stepped(Op op) {
  return tape::is_truth(op) || std::ranges::find(stepped, op) != std::end(stepped);
}

}  // namespace

Stepwise::Stepwise(const Plan& plan)
    : plan_(plan),
      nodes_(plan.nodes.size(), unknown),
      no_values_(plan.nodes.size(), Expressions::variable) {}

bool Stepwise::is_node(int i) {
  const Node& node = plan_.node(i);
  if (nodes_[i] == unknown)
    nodes_[i] = is_formula(plan_.output_of(node).formula, node.leaf, node.place.size) ? yes : no;
  return nodes_[i] == yes;
}

bool Stepwise::is_guard(const GuardGroup& group) const {
  if (group.is_opaque()) return true;
  const Formula& formula = group.is_crossing() ? plan_.crossing_of(group).formula
                                               : plan_.relation_of(plan_.node(group.index)).formula;
  return is_formula(formula, group.leaf, group.size);
}

bool Stepwise::is_formula(const Formula& formula, int leaf, Index size) const {
  const Formula* known = fusible(formula, size);
  if (known == nullptr) return true;
  Expressions values(plan_, no_values_);
  values.add(*known, leaf, size);
  const tape::Graph& graph = values.graph();
  for (int id = 0; id < graph.size(); ++id)
    if (is_stepped(graph[{id}].op)) return true;
  return false;
}

}  // namespace saltus::detail
