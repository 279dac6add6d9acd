// Stepwise: a formula is searched for operations that have steps.
#include "stepwise.hpp"

#include <algorithm>

#include "expressions.hpp"
#include "fusible.hpp"

namespace saltus::detail {

namespace {

using tape::Op;

enum Answer : char { unknown, no, yes };

/// The operations whose value may be constant where that of an operand varies. No comparison is
/// among them.
constexpr Op stepped[] = {Op::floor, Op::ceil,         Op::trunc,   Op::rint,
                          Op::sign,  Op::floor_divide, Op::minimum, Op::maximum};

bool is_stepped(Op op) {
  return tape::is_truth(op) || std::ranges::find(stepped, op) != std::end(stepped);
}

List<char> varying_entries(const Plan& plan) {
  List<char> varies(plan.ny, no);
  for (const Node& node : plan.nodes) {
    if (node.rate != Rate::continuous || node.place.space != Space::y) continue;
    for (Index k = 0; k < node.place.size; ++k) varies[node.place.offset + k] = yes;
  }
  return varies;
}

}  // namespace

Stepwise::Stepwise(const Plan& plan)
    : plan_(plan),
      nodes_(plan.nodes.size(), unknown),
      varies_(varying_entries(plan)),
      states_(plan.ny, unknown),
      no_values_(plan.nodes.size(), Expressions::variable) {}

bool Stepwise::is_node(int i) {
  const Node& node = plan_.node(i);
  if (nodes_[i] == unknown)
    nodes_[i] = is_formula(plan_.output_of(node).formula, node.leaf, node.place.size) ? yes : no;
  return nodes_[i] == yes;
}

bool Stepwise::is_guard(const GuardGroup& group) {
  if (group.is_opaque()) return true;
  const Formula& formula = group.is_crossing() ? plan_.crossing_of(group).formula
                                               : plan_.relation_of(plan_.node(group.index)).formula;
  return is_formula(formula, group.leaf, group.size);
}

bool Stepwise::is_state(int i, Index k) {
  const Node& node = plan_.node(i);
  if (node.view) return true;
  if (states_[node.place.offset] == unknown) find_states(node);
  return states_[node.place.offset + k] == yes;
}

void Stepwise::find_states(const Node& node) {
  for (Index k = 0; k < node.place.size; ++k) states_[node.place.offset + k] = no;
  const Formula& formula = plan_.output_of(node).formula;
  if (!is_narrow(formula, node.place.size)) return;
  Expressions values(plan_, no_values_);
  Index at = node.place.offset;
  for (const tape::Node entry : values.add(formula, node.leaf, node.place.size)) {
    if (values.graph()[entry].op == Op::continuous_state) states_[at] = yes;
    ++at;
  }
}

/// A formula that is called by itself is known as well.
bool Stepwise::is_formula(const Formula& formula, int leaf, Index size) {
  if (!is_narrow(formula, size)) return true;
  Expressions values(plan_, no_values_);
  values.add(formula, leaf, size);
  return has_step(values.graph());
}

/// A choice by a held value, as a mode, is none: nothing changes it between instants.
bool Stepwise::has_step(const tape::Graph& graph) const {
  List<char> varies;
  for (int id = 0; id < graph.size(); ++id) {
    const tape::Expression& e = graph[{id}];
    const auto operand = [&](int k) {
      return varies[e.operands[static_cast<std::size_t>(k)].id] != no;
    };
    bool any = varies_by_itself(e);
    for (int k = 0; k < operand_count(e.op); ++k) any = any || operand(k);
    if (e.op == Op::select ? operand(0) : any && is_stepped(e.op)) return true;
    varies.push_back(any ? yes : no);
  }
  return false;
}

/// The signals of the plan are the discrete state of its graphs, see Expressions.
bool Stepwise::varies_by_itself(const tape::Expression& e) const {
  if (e.op == Op::discrete_state) return varies_[e.index] == yes;
  return e.op == Op::time || e.op == Op::continuous_state;
}

}  // namespace saltus::detail
