// The expressions of a whole plan: outputs in the order of the plan, then odes, then guards.
#include "saltus/plan/detail/flow_graph.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <utility>

#include "expressions.hpp"
#include "saltus/plan/detail/needs.hpp"

namespace saltus {

namespace {

using detail::append, detail::Expressions, detail::read_inputs;

/// One pass over a plan. An output has no expression if it has no formula, or if it reads an output
/// without an expression.
class Pass {
 public:
  explicit Pass(const Plan& plan)
      : plan_(plan),
        first_(plan.nodes.size(), Expressions::variable),
        called_(plan.nodes.size(), 0),
        values_(plan, first_) {}

  FlowGraph run() {
    add_outputs(plan_.needs.derivatives);
    made_.rates.assign(plan_.nx, values_.graph().constant(0.0));
    for (const int leaf : plan_.odes) {
      if (!add_rates(plan_.leaf(leaf))) return {.obstacle = obstacle_};
    }
    add_outputs(plan_.needs.guards);
    made_.guards.resize(plan_.guard_slots);
    for (const GuardGroup& group : plan_.guards) add_guards(group);
    made_.graph = std::move(values_.graph());
    return std::move(made_);
  }

 private:
  void add_outputs(const std::vector<int>& nodes) {
    for (const int i : nodes) {
      const Node& node = plan_.node(i);
      const bool known = first_[i] != Expressions::variable || called_[i] != 0;
      if (known) continue;
      if (!node.relation && plan_.output_of(node).formula && !reads_called(node.needs))
        values_.compute(i);
      else
        called_[i] = 1;
    }
  }

  bool add_rates(const PlanLeaf& leaf) {
    const ContinuousState& state = leaf.declared().continuous;
    const auto number = static_cast<int>(&leaf - plan_.leaves.data());
    if (!state.ode) return true;
    std::vector<int> needs;
    if (has(state.reads, Reads::inputs)) needs = read_inputs(state.inputs, leaf);
    if (has(state.reads, Reads::relations)) append(needs, leaf.relations);
    const auto called = first_called(needs);
    if (called) obstacle_ = text("output '", plan_.name_of(plan_.node(*called)), "'");
    if (!state.formula) obstacle_ = text("the derivative of block '", leaf.path, "'");
    if (called || !state.formula) return false;
    const auto rates = values_.add(state.formula, number, leaf.nx);
    std::ranges::copy(rates, made_.rates.begin() + leaf.x);
    return true;
  }

  void add_guards(const GuardGroup& group) {
    const Formula* formula = formula_of(group);
    if (formula == nullptr) return;
    const auto guards = values_.add(*formula, group.leaf, group.size);
    std::copy(guards.begin(), guards.end(), made_.guards.begin() + group.slot);
  }
  /// The formula of a group whose guards have expressions; otherwise null.
  const Formula* formula_of(const GuardGroup& group) const {
    if (group.is_opaque()) return nullptr;
    const PlanLeaf& leaf = plan_.leaf(group.leaf);
    std::vector<int> needs;
    if (group.is_crossing()) {
      needs = read_inputs(plan_.crossing_of(group).inputs, leaf);
      append(needs, leaf.relations);
    } else {
      needs = plan_.node(group.index).needs;
    }
    const Formula& formula = group.is_crossing()
                                 ? plan_.crossing_of(group).formula
                                 : plan_.relation_of(plan_.node(group.index)).formula;
    return formula && !reads_called(needs) ? &formula : nullptr;
  }

  std::optional<int> first_called(const std::vector<int>& nodes) const {
    const auto found = std::ranges::find_if(nodes, [&](int i) { return called_[i] != 0; });
    return found == nodes.end() ? std::nullopt : std::optional(*found);
  }
  bool reads_called(const std::vector<int>& nodes) const { return first_called(nodes).has_value(); }

  const Plan& plan_;
  List<int> first_;
  List<char> called_;  // computed between instants, by a call
  Expressions values_;
  FlowGraph made_;
  std::string obstacle_;
};

}  // namespace

FlowGraph flow_graph(const Plan& plan) { return Pass(plan).run(); }

SignalGraph signal_graph(const Plan& plan) {
  List<int> first(plan.nodes.size(), Expressions::variable);
  Expressions values(plan, first);
  SignalGraph made;
  for (const int i : plan.needs.instants) {
    const Node& node = plan.node(i);
    if (node.relation || node.boolean) continue;
    if (!plan.output_of(node).formula) {
      made.whole = false;
      continue;
    }
    values.compute(i);
    for (const tape::Node& value : values.of_node(i)) made.values.push_back(value);
    for (Index k = 0; k < node.place.size; ++k) made.places.push_back(node.place.offset + k);
  }
  made.graph = std::move(values.graph());
  return made;
}

}  // namespace saltus
