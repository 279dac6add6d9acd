// FlowGraph: the derivatives and the guards of a whole plan as expressions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus {

/// xdot(t, x) and the guards as nodes of one graph. Its variables are x, p, the held signals y as
/// the discrete state, all of z as input 0, and the modes of the leaves, as numbers, as input 1.
/// All but t and x are constant between two instants.
struct FlowGraph {
  tape::Graph graph = {};
  List<tape::Node> rates = {};                  ///< of each state; empty: see `obstacle`
  List<std::optional<tape::Node>> guards = {};  ///< by slot; none for a called guard
  std::string obstacle = {};                    ///< the first function without an expression
};

/// The expressions of a plan whose functions are formulas or traced.
FlowGraph flow_graph(const Plan& plan);

/// The signals that instants compute, as nodes of one graph with the variables of a FlowGraph. A truth,
/// and a signal that is called, are variables.
struct SignalGraph {
  tape::Graph graph = {};
  std::vector<tape::Node> values = {};
  std::vector<Index> places = {};  ///< of the values, among all signals
  bool whole = true;               ///< whether no signal is called
};

SignalGraph signal_graph(const Plan& plan);

}  // namespace saltus
