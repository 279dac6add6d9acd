// The part of a graph that some nodes need.
#pragma once

#include <span>
#include <vector>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// The nodes that `outputs` need, in an order in which operands come first and an operation comes
/// soon after its last operand.
std::vector<Node> needed(const Graph& graph, std::span<const Node> outputs);

/// Writes `outputs` and the nodes they need to an empty graph; returns them as its nodes.
std::vector<Node> copy(const Graph& from, std::span<const Node> outputs, Graph& to);

}  // namespace saltus::tape
