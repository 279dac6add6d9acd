// Whether a derivative may hide a part of itself from its series at one point.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "saltus/solver/detail/taylor/step_rule.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::taylor {

/// Points inside a step where such a derivative is compared with the series, and the most by which a
/// step of it may be longer than the longest before. Both are about those of dop853, whose step
/// evaluates f at eleven places and grows sixfold at most.
inline constexpr int hidden_looks = 8;
inline constexpr double hidden_growth = 6.0;

/// A pulse such as exp(-100 (t - 13)^2) is zero within the rounding at t = 0, with all of its
/// derivatives, and so is its series there: neither shows that the pulse will come. A function with
/// a pole bounds the radius of convergence, a polynomial or an entire function that does not decay
/// shows in its first coefficients. What remains is exp and its relatives, and powers of a higher
/// degree than the series.
inline bool hides(const tape::Graph& graph, const tape::Expression& e) {
  using tape::Op;
  if (e.op == Op::pow) {
    const auto exponent = graph.value(e.operands[1]);
    return !exponent || std::abs(*exponent) > least_order;
  }
  return e.op == Op::exp || e.op == Op::exp2 || e.op == Op::expm1 || e.op == Op::sinh ||
         e.op == Op::cosh;
}

/// Whether `nodes` need an operation that hides.
inline bool may_hide(const tape::Graph& graph, std::span<const tape::Node> nodes) {
  std::vector<char> needed(static_cast<std::size_t>(graph.size()), 0);
  for (const tape::Node node : nodes) needed[static_cast<std::size_t>(node.id)] = 1;
  for (int id = graph.size() - 1; id >= 0; --id) {
    if (needed[static_cast<std::size_t>(id)] == 0) continue;
    const tape::Expression& e = graph[{id}];
    if (hides(graph, e)) return true;
    for (int k = 0; k < tape::operand_count(e.op); ++k)
      needed[static_cast<std::size_t>(e.operands[static_cast<std::size_t>(k)].id)] = 1;
  }
  return false;
}

}  // namespace saltus::taylor
