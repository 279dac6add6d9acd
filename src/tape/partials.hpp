// The derivative of one operation with respect to one of its operands.
#pragma once

#include <optional>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// d(node) / d(operand k) as an expression; empty if it is zero everywhere. It does not handle
/// operations that choose.
std::optional<Node> partial(Graph& graph, Node node, std::size_t k);

/// Whether an operation returns one of its operands unchanged: select, minimum, maximum.
constexpr bool chooses(Op op) { return op == Op::select || op == Op::minimum || op == Op::maximum; }

}  // namespace saltus::tape
