// The order in which expressions are computed, and the expressions that are computed together.
#pragma once

#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::tape::detail {

/// Expressions that one instruction computes: a single one, or a run of the same operation. The
/// operands of a run are adjacent, or at equal distances, or the same for all.
using Group = std::vector<Node>;

/// The decisions of `arrange`.
struct Arrangement {
  std::vector<Group> groups = {};  ///< operands first
  /// Says for each node whether the operands of its commutative operation are exchanged.
  List<bool> swapped = {};
  /// Arrays of expressions that get adjacent registers: expressions of one operation that do not
  /// need each other. An operation on several groups of an array can then be a run, too. The list
  /// is empty if there is no run.
  List<std::vector<Node>> arrays = {};
};

/// The operations that `outputs` need. If a model has rows of similar equations, as a rod of many
/// cells has, they become runs. Operands of commutative operations are exchanged if this brings the
/// operands of a run into one order.
Arrangement arrange(const Graph& graph, std::span<const Node> outputs);

/// Shorter runs are computed one by one.
inline constexpr std::size_t shortest_run = 4;

}  // namespace saltus::tape::detail
