// In which order expressions are computed, and which of them at once.
#pragma once

#include <vector>

#include "saltus/tape/graph.hpp"

namespace saltus::tape::detail {

/// Expressions that one instruction computes: one, or a run of the same operation on operands that
/// stand side by side, or at equal distances, or are the same for all.
using Group = std::vector<Node>;

/// The operations that `outputs` need, operands first. Where a model has rows of like equations,
/// as a rod of many cells has, they become runs. Operands of operations that commute are
/// exchanged where that puts those of a run in one order: `swapped` says for each node.
std::vector<Group> arrange(const Graph& graph, std::span<const Node> outputs,
                           std::vector<bool>& swapped);

/// Fewer are computed one by one.
inline constexpr std::size_t shortest_run = 4;

}  // namespace saltus::tape::detail
