// The derivative of one operation with respect to one of its operands.
#pragma once

#include <optional>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// d(node) / d(operand k) as an expression; empty where it is zero everywhere. Not for operations
/// that choose.
std::optional<Node> partial(Graph& graph, Node node, std::size_t k);

/// An operation that gives one of its operands as it is: select, minimum, maximum.
constexpr bool chooses(Op op) { return op == Op::select || op == Op::minimum || op == Op::maximum; }

}  // namespace saltus::tape
