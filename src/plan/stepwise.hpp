// Stepwise: which functions of a plan may be constant while the values that they read vary.
#pragma once

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::detail {

/// A called function may be constant in pieces, as floor(u) is, and so may a formula with a step. Any
/// other formula varies as the values that it reads.
class Stepwise {
 public:
  explicit Stepwise(const Plan& plan);

  bool is_node(int i);
  bool is_guard(const GuardGroup& group);
  /// Whether entry k of a node is an entry of a state: a view, or a formula that says no more.
  bool is_state(int i, Index k);

 private:
  void find_states(const Node& node);
  bool is_formula(const Formula& formula, int leaf, Index size);
  bool has_step(const tape::Graph& graph) const;
  bool varies_by_itself(const tape::Expression& expression) const;

  const Plan& plan_;
  List<char> nodes_;     // an answer for each
  List<char> varies_;    // whether an entry of y varies between instants
  List<char> states_;    // an answer for each entry of y
  List<int> no_values_;  // all values are variables of a formula
};

}  // namespace saltus::detail
