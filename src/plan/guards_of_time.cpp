// The guards that follow the time itself, by what their functions and the signals behind them read.
#include <algorithm>
#include <vector>

#include "expressions.hpp"
#include "fusible.hpp"
#include "saltus/base/list.hpp"
#include "saltus/plan/detail/leaf_function.hpp"
#include "saltus/plan/detail/needs.hpp"
#include "saltus/plan/detail/passes.hpp"

namespace saltus {

namespace {

bool has_time(const tape::Graph& graph) {
  for (int id = 0; id < graph.size(); ++id)
    if (graph[{id}].op == tape::Op::time) return true;
  return false;
}

class TimeFollowers {
 public:
  explicit TimeFollowers(const Plan& plan)
      : plan_(plan),
        nodes_(plan.nodes.size(), FollowsTime::no),
        no_values_(plan.nodes.size(), detail::Expressions::variable) {
    for (const int i : plan.order) nodes_[i] = of_node(plan.node(i));
  }

  FollowsTime of_guard(const GuardGroup& group) {
    if (group.is_opaque()) return of_nodes(plan_.node(group.index).needs);  // its own values jump
    if (!group.is_crossing()) return of_function(plan_.node(group.index));
    const FollowsTime own =
        of_own(plan_.crossing_of(group).formula, Reads::everything, group.leaf, group.size);
    return std::max(own, of_nodes(nodes_of_guard(plan_, group)));
  }

 private:
  /// A value that is held between instants follows nothing.
  FollowsTime of_node(const Node& node) {
    return node.rate == Rate::continuous ? of_function(node) : FollowsTime::no;
  }

  FollowsTime of_function(const Node& node) {
    const Formula& formula =
        node.relation ? plan_.relation_of(node).formula : plan_.output_of(node).formula;
    const FollowsTime own =
        of_own(formula, detail::reads_of(plan_, node), node.leaf, node.place.size);
    return std::max(own, of_nodes(node.needs));
  }

  /// What a function reads itself, by its expression or by its declaration.
  FollowsTime of_own(const Formula& formula, Reads reads, int leaf, Index size) {
    if (!has(reads, Reads::time)) return FollowsTime::no;
    if (detail::is_narrow(formula, size)) {
      detail::Expressions values(plan_, no_values_);
      values.add(formula, leaf, size);
      return has_time(values.graph()) ? FollowsTime::yes : FollowsTime::no;
    }
    return reads == Reads::everything ? FollowsTime::perhaps : FollowsTime::yes;
  }

  FollowsTime of_nodes(const std::vector<int>& nodes) const {
    FollowsTime most = FollowsTime::no;
    for (const int i : nodes) most = std::max(most, nodes_[i]);
    return most;
  }

  const Plan& plan_;
  List<FollowsTime> nodes_;
  List<int> no_values_;  // all values are variables of a formula
};

}  // namespace

void detail::find_guards_that_follow_time(Plan& plan) {
  if (plan.guards.empty()) return;
  TimeFollowers followers(plan);
  for (GuardGroup& group : plan.guards) group.follows_time = followers.of_guard(group);
}

}  // namespace saltus
