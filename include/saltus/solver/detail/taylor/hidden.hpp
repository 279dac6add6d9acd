// Whether a derivative may hide a part of itself from its series at one point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "saltus/tape/graph.hpp"

namespace saltus::taylor {

/// Points inside a step at which such a derivative is compared with the series, and the most by
/// which a step may be longer than the longest before. A step of dop853 has eleven such points, and
/// is at most six times as long as the one before.
inline constexpr int hidden_looks = 8;
inline constexpr double hidden_growth = 6.0;

/// From this degree on, a product may be flat within the rounding at a point, and large elsewhere:
/// (4 t (1 - t))^16 is below 1e-12 up to t = 0.04.
inline constexpr double hidden_degree = 8.0;

/// Whether an operation decays so fast that its tail is below the rounding, with all derivatives.
inline bool decays(tape::Op op) {
  using tape::Op;
  return op == Op::exp || op == Op::exp2 || op == Op::expm1 || op == Op::sinh || op == Op::cosh ||
         op == Op::tanh;
}

/// The degree of an expression in functions of time and states, from those of its operands.
inline double degree_of(const tape::Graph& graph, const tape::Expression& e,
                        const std::array<double, 3>& of) {
  using tape::Op;
  if (e.op == Op::time || e.op == Op::continuous_state) return 1.0;
  if (e.op == Op::mul || e.op == Op::div) return of[0] + of[1];
  const double largest = *std::ranges::max_element(of);
  if (e.op == Op::add || e.op == Op::sub || e.op == Op::neg || e.op == Op::select) return largest;
  if (e.op == Op::pow) {
    const auto exponent = graph.value(e.operands[1]);
    return exponent ? of[0] * std::abs(*exponent) : of[0] + of[1] > 0.0 ? hidden_degree : 0.0;
  }
  return largest > 0.0 ? 1.0 : 0.0;
}

/// Whether `nodes` may be zero within the rounding at a point, with all derivatives, and large
/// elsewhere: a pulse such as exp(-100 (t - 13)^2) at t = 0. Neither their values nor their series
/// show that the pulse will come. This cannot be known from a list of operations, and does not claim
/// to be complete: sqrt((t - 0.3)^2) has a kink that no series at 0 shows. The check at the end of
/// a step sees what lasts until then.
inline bool may_hide(const tape::Graph& graph, std::span<const tape::Node> nodes) {
  const auto index = [](tape::Node node) { return static_cast<std::size_t>(node.id); };
  std::vector<char> needed(static_cast<std::size_t>(graph.size()), 0);
  for (const tape::Node node : nodes) needed[index(node)] = 1;
  for (int id = graph.size() - 1; id >= 0; --id) {
    const tape::Expression& e = graph[{id}];
    if (needed[index({id})] == 0) continue;
    for (int k = 0; k < tape::operand_count(e.op); ++k)
      needed[index(e.operands[static_cast<std::size_t>(k)])] = 1;
  }
  std::vector<double> degrees(needed.size(), 0.0);
  for (int id = 0; id < graph.size(); ++id) {
    const tape::Expression& e = graph[{id}];
    if (needed[index({id})] == 0) continue;
    std::array<double, 3> of{};
    for (int k = 0; k < tape::operand_count(e.op); ++k)
      of[static_cast<std::size_t>(k)] = degrees[index(e.operands[static_cast<std::size_t>(k)])];
    degrees[index({id})] = degree_of(graph, e, of);
    if (degrees[index({id})] >= hidden_degree || (decays(e.op) && of[0] > 0.0)) return true;
  }
  return false;
}

}  // namespace saltus::taylor
