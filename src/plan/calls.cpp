// Calls: made once, from a plan.
#include "saltus/plan/detail/calls.hpp"

#include <algorithm>
#include <iterator>

#include "guard_cones.hpp"

namespace saltus {

namespace {

/// Derivative of a leaf without an ode, whose states only reset maps change: zero.
const VectorFunction& still() {
  static const VectorFunction zero([](const At&, VectorRef xdot) { xdot.setZero(); });
  return zero;
}

class Maker {
 public:
  Maker(const Plan& plan, std::vector<At>& views) : plan_(plan), views_(views) {}

  Call call(const VectorFunction& function, int leaf) {
    const PlanLeaf& of = plan_.leaf(leaf);
    const auto number = static_cast<std::size_t>(leaf);
    return {&function, of.system, number, &views_[number], of.x, of.nx};
  }

  /// A call of a function over the whole machine. A tape needs no leaf and no mode, so any leaf
  /// will do.
  Call whole(const VectorFunction& fused) {
    return {&fused, plan_.leaves.front().system, 0, &views_.back(), 0, plan_.nx};
  }

  std::vector<OutputCall> outputs(const std::vector<int>& nodes) {
    std::vector<OutputCall> calls;
    for (const int i : nodes) {
      const Node& node = plan_.node(i);
      const VectorFunction& function =
          node.relation ? plan_.relation_of(node).guard : plan_.output_of(node).calc;
      calls.push_back({call(function, node.leaf), node.place.offset, node.place.size, node.relation,
                       node.relation && plan_.relation_of(node).true_at_zero});
    }
    return calls;
  }

  /// The calls of a walk, with its fused formulas.
  std::vector<OutputCall> outputs(const Walk& walk, const std::vector<int>& nodes) {
    if (!walk.fuses()) return outputs(nodes);
    std::vector<OutputCall> calls;
    for (const Walk::Stage& stage : walk.stages) {
      if (stage.fused) calls.push_back({whole(stage.fused), 0, plan_.ny, false, false});
      std::ranges::copy(outputs(stage.calls), std::back_inserter(calls));
    }
    return calls;
  }

  std::vector<Call> odes(const Walk& walk) {
    std::vector<Call> calls;
    if (walk.last) calls.push_back(whole(walk.last));
    for (std::size_t i = 0; i < plan_.odes.size(); ++i) {
      if (walk.fuses() && walk.fused[i]) continue;
      const VectorFunction& ode = plan_.leaf(plan_.odes[i]).declared().continuous.ode.function;
      calls.push_back(call(ode ? ode : still(), plan_.odes[i]));
    }
    return calls;
  }

  GuardCall guard(const GuardGroup& group) {
    const VectorFunction& function = group.is_crossing() ? plan_.crossing_of(group).guard
                                     : group.is_opaque()
                                         ? plan_.output_of(plan_.node(group.index)).calc
                                         : plan_.relation_of(plan_.node(group.index)).guard;
    return {call(function, group.leaf), group.slot, group.size, group.is_opaque()};
  }

 private:
  const Plan& plan_;
  std::vector<At>& views_;
};

/// The nodes that change between instants too.
std::vector<int> continuous(const Plan& plan) {
  std::vector<int> nodes;
  std::ranges::copy_if(plan.needs.instants, std::back_inserter(nodes),
                       [&](int i) { return plan.node(i).rate == Rate::continuous; });
  return nodes;
}

}  // namespace

Calls::Calls(const Plan& plan, std::vector<At>& views) {
  Maker make(plan, views);
  constants = make.outputs(plan.needs.constants);
  instants = make.outputs(plan.needs.instants);
  moving = make.outputs(continuous(plan));
  needs_of_derivatives = make.outputs(plan.needs.derivatives);
  derivatives = make.outputs(plan.walks.derivatives, plan.needs.derivatives);
  guard_needs = make.outputs(plan.walks.guards, plan.needs.guards);
  taps = make.outputs(plan.needs.taps);
  histories = make.outputs(plan.needs.histories);
  odes = make.odes(plan.walks.derivatives);
  single_odes = make.odes({});
  for (const GuardGroup& group : plan.guards) guards.push_back(make.guard(group));
  guard_cones = detail::guard_cones(plan);
  if (plan.walks.guards.last)
    fused_guards = {make.whole(plan.walks.guards.last), 0, plan.guard_slots, false};
}

}  // namespace saltus
