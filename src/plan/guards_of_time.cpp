// The guards that may turn within a step that suits the states, by their functions and the signals behind them.
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

/// Whether the operation takes a number that only grows up and down again, or lets it jump back.
bool turns(tape::Op op) {
  using enum tape::Op;
  switch (op) {
    case sin:
    case cos:
    case tan:
    case floor:
    case ceil:
    case trunc:
    case rint:
    case mod:
    case fmod:
    case floor_divide:
      return true;
    default:
      return false;
  }
}

bool has_time(const tape::Graph& graph) {
  for (int id = 0; id < graph.size(); ++id)
    if (graph[{id}].op == tape::Op::time) return true;
  return false;
}

/// Whether an expression has an operation that turns, of a state. `signals`: whether the signals of other
/// blocks vary.
bool has_turn(const tape::Graph& graph, bool signals) {
  List<char> varies(graph.size(), 0);
  for (int id = 0; id < graph.size(); ++id) {
    const tape::Expression& each = graph[{id}];
    varies[id] =
        each.op == tape::Op::continuous_state || (each.op == tape::Op::discrete_state && signals);
    for (int k = 0; k < tape::operand_count(each.op); ++k)
      varies[id] = varies[id] || varies[each.operands[k].id];
    if (varies[id] && turns(each.op)) return true;
  }
  return false;
}

/// How a value may turn within a step that suits the states.
struct Turning {
  FollowsTime time = FollowsTime::no;
  bool by_state = false;

  Turning with(Turning other) const {
    return {std::max(time, other.time), by_state || other.by_state};
  }
};

class FastGuards {
 public:
  explicit FastGuards(const Plan& plan)
      : plan_(plan),
        nodes_(plan.nodes.size()),
        no_values_(plan.nodes.size(), detail::Expressions::variable) {
    const detail::Marks behind = behind_guards();
    for (const int i : plan.order)
      if (behind[i]) nodes_[i] = of_node(plan.node(i));
  }

  Turning of_guard(const GuardGroup& group) {
    if (group.is_opaque()) return of_nodes(plan_.node(group.index).needs);  // its own values jump
    if (!group.is_crossing()) return of_function(plan_.node(group.index));
    const std::vector<int> needs = nodes_of_guard(plan_, group);
    const Turning own = of_own(plan_.crossing_of(group).formula, Reads::everything, group.leaf,
                               group.size, are_continuous(needs));
    return own.with(of_nodes(needs));
  }

 private:
  /// The nodes behind the guards. Nothing is asked of other nodes.
  detail::Marks behind_guards() const {
    std::vector<int> roots;
    for (const GuardGroup& group : plan_.guards) detail::append(roots, nodes_read(plan_, group));
    detail::Marks marks(plan_.nodes.size(), 0);
    detail::spread(plan_, roots, marks,
                   [](const Node& node) { return node.rate != Rate::continuous; });
    return marks;
  }

  /// A value that is held between instants follows nothing.
  Turning of_node(const Node& node) {
    return node.rate == Rate::continuous ? of_function(node) : Turning{};
  }

  Turning of_function(const Node& node) {
    const Formula& formula =
        node.relation ? plan_.relation_of(node).formula : plan_.output_of(node).formula;
    const Turning own = of_own(formula, detail::reads_of(plan_, node), node.leaf, node.place.size,
                               are_continuous(node.needs));
    return own.with(of_nodes(node.needs));
  }

  /// What a function does itself, by its expression or by its declaration. `signals`: whether the signals
  /// that it reads vary.
  Turning of_own(const Formula& formula, Reads reads, int leaf, Index size, bool signals) {
    if (detail::is_narrow(formula, size)) {
      detail::Expressions values(plan_, no_values_);
      values.add(formula, leaf, size);
      return {has_time(values.graph()) ? FollowsTime::yes : FollowsTime::no,
              has_turn(values.graph(), signals)};
    }
    if (!has(reads, Reads::time)) return {};
    const bool undeclared = (reads | Reads::outside) == (Reads::everything | Reads::outside);
    return {undeclared ? FollowsTime::perhaps : FollowsTime::yes};
  }

  bool are_continuous(const std::vector<int>& nodes) const {
    return std::ranges::any_of(nodes,
                               [&](int i) { return plan_.node(i).rate == Rate::continuous; });
  }

  Turning of_nodes(const std::vector<int>& nodes) const {
    Turning most;
    for (const int i : nodes) most = most.with(nodes_[i]);
    return most;
  }

  const Plan& plan_;
  List<Turning> nodes_;
  List<int> no_values_;  // all values are variables of a formula
};

}  // namespace

void detail::find_guards_that_turn(Plan& plan) {
  if (plan.guards.empty()) return;
  FastGuards fast(plan);
  for (GuardGroup& group : plan.guards) {
    const Turning found = fast.of_guard(group);
    group.follows_time = found.time, group.turns = found.by_state;
  }
}

}  // namespace saltus
