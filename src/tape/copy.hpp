// The part of a graph that some nodes need.
#pragma once

#include <span>
#include <vector>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// Which nodes are needed for `outputs`, in an order in which operands come first and an operation
/// soon after its last operand.
std::vector<Node> needed(const Graph& graph, std::span<const Node> outputs);

/// Writes `outputs` and what they need into an empty graph; returns them as nodes of it.
std::vector<Node> copy(const Graph& from, std::span<const Node> outputs, Graph& to);

}  // namespace saltus::tape
