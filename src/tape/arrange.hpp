// The order in which expressions are computed, and the expressions that are computed together.
#pragma once

#include <vector>

#include "saltus/tape/graph.hpp"

namespace saltus::tape::detail {

/// Expressions that one instruction computes: a single one, or a run of the same operation. The
/// operands of a run are adjacent, or at equal distances, or the same for all.
using Group = std::vector<Node>;

/// The operations that `outputs` need, operands first. If a model has rows of similar equations, as
/// a rod of many cells has, they become runs. Operands of commutative operations are exchanged if
/// this brings the operands of a run into one order; `swapped` records it for each node.
std::vector<Group> arrange(const Graph& graph, std::span<const Node> outputs,
                           std::vector<bool>& swapped);

/// Shorter runs are computed one by one.
inline constexpr std::size_t shortest_run = 4;

}  // namespace saltus::tape::detail
