// Helpers: the expressions that a lowering adds to its graph.
#pragma once

#include "saltus/tape/graph.hpp"

namespace saltus::tape::series {

/// Builds expressions of a graph from the numbers of others.
class Helpers {
 protected:
  explicit Helpers(Graph& graph) : graph_(graph) {}

  Node n(double value) { return graph_.constant(value); }
  Node of(Op op, Node a) { return graph_.unary(op, a); }
  Node of(Op op, Node a, Node b) { return graph_.binary(op, a, b); }
  Node times(Node a, Node b) { return of(Op::mul, a, b); }
  Node sum_of_squares(Node a, Node b) { return of(Op::add, times(a, a), times(b, b)); }

  Graph& graph_;
};

}  // namespace saltus::tape::series
