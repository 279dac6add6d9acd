// Identities that make an expression shorter and hold to the last bit.
#pragma once

#include <optional>
#include <span>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// A node with the same value that exists already or is simpler to compute; empty if none is known.
std::optional<Node> simplified(Graph& graph, Op op, std::span<const Node> operands);

}  // namespace saltus::tape
