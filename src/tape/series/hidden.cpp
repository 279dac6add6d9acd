// Whether expressions may hide a part of themselves from their series at one point.
#include <algorithm>
#include <array>
#include <cmath>

#include "../copy.hpp"
#include "saltus/tape/series.hpp"

namespace saltus::tape {

namespace {

/// From this degree on, a product may be flat within the rounding at a point, and large elsewhere:
/// (4 t (1 - t))^16 is below 1e-12 up to t = 0.04.
constexpr double hidden_degree = 8.0;

/// Whether an operation decays so fast that its tail is below the rounding, with all derivatives.
bool decays(Op op) {
  return op == Op::exp || op == Op::exp2 || op == Op::expm1 || op == Op::sinh || op == Op::cosh ||
         op == Op::tanh;
}

/// The degree of a power. If the exponent varies, the degree has no bound.
double degree_of_power(const Graph& graph, const Expression& e, const std::array<double, 3>& of) {
  if (const auto exponent = graph.value(e.operands[1])) return of[0] * std::abs(*exponent);
  return of[0] + of[1] > 0.0 ? hidden_degree : 0.0;
}

/// The degree of an expression in functions of time and states, from those of its operands.
double degree_of(const Graph& graph, const Expression& e, const std::array<double, 3>& of) {
  const double largest = *std::ranges::max_element(of);
  switch (e.op) {
    case Op::time:
    case Op::continuous_state:
      return 1.0;
    case Op::mul:
    case Op::div:
      return of[0] + of[1];
    case Op::add:
    case Op::sub:
    case Op::neg:
    case Op::select:
      return largest;
    case Op::pow:
      return degree_of_power(graph, e, of);
    default:
      return largest > 0.0 ? 1.0 : 0.0;
  }
}

}  // namespace

bool may_hide(const Graph& graph, std::span<const Node> nodes) {
  std::vector<double> degrees(static_cast<std::size_t>(graph.size()), 0.0);
  for (const Node node : needed(graph, nodes)) {
    const Expression& e = graph[node];
    std::array<double, 3> of{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(operand_count(e.op)); ++k)
      of[k] = degrees[static_cast<std::size_t>(e.operands[k].id)];
    const double degree = degree_of(graph, e, of);
    if (degree >= hidden_degree || (decays(e.op) && of[0] > 0.0)) return true;
    degrees[static_cast<std::size_t>(node.id)] = degree;
  }
  return false;
}

}  // namespace saltus::tape
