#include "simplify.hpp"

#include <bit>
#include <cmath>

namespace saltus::tape {

namespace {

using Operands = std::span<const Node>;
using Found = std::optional<Node>;

bool is(const Graph& graph, Node node, Op op) { return graph[node].op == op; }
bool is(const Graph& graph, Node node, double number) {
  const auto value = graph.value(node);
  return value && std::bit_cast<std::uint64_t>(*value) == std::bit_cast<std::uint64_t>(number);
}
Node operand(const Graph& graph, Node node, std::size_t i = 0) { return graph[node].operands[i]; }

/// Whether a node never has the value -0.0, whatever the variables are. It examines a few levels
/// only.
bool never_minus_zero(const Graph& graph, Node node, int levels = 4) {
  const Expression& e = graph[node];
  switch (e.op) {
    case Op::constant:
      return !is(graph, node, -0.0);
    case Op::abs:
    case Op::exp:
    case Op::exp2:
    case Op::cosh:
    case Op::hypot:
    case Op::acos:
    case Op::sign:
    case Op::mode:
    case Op::entry:
      return true;
    case Op::mul:
      return e.operands[0] == e.operands[1];
    case Op::add:  // only -0.0 + -0.0 is -0.0
      return levels > 0 && (never_minus_zero(graph, e.operands[0], levels - 1) ||
                            never_minus_zero(graph, e.operands[1], levels - 1));
    case Op::select:
      return levels > 0 && never_minus_zero(graph, e.operands[1], levels - 1) &&
             never_minus_zero(graph, e.operands[2], levels - 1);
    default:
      return is_truth(e.op);
  }
}

Found of_one(Graph& graph, Op op, Node a) {
  const Op inner = graph[a].op;
  const bool whole = inner >= Op::floor && inner <= Op::sign;
  switch (op) {
    case Op::neg:
      return inner == Op::neg ? Found(operand(graph, a)) : Found();
    case Op::abs:
      if (inner == Op::neg) return graph.unary(Op::abs, operand(graph, a));
      return inner == Op::abs || inner == Op::exp || is_truth(inner) ? Found(a) : Found();
    case Op::floor:
    case Op::ceil:
    case Op::trunc:
    case Op::rint:
      return whole || is_truth(inner) ? Found(a) : Found();
    case Op::sign:
      return inner == Op::sign || is_truth(inner) ? Found(a) : Found();
    case Op::logical_not:
      if (inner == Op::eq) return graph.binary(Op::ne, operand(graph, a), operand(graph, a, 1));
      if (inner == Op::ne) return graph.binary(Op::eq, operand(graph, a), operand(graph, a, 1));
      if (inner == Op::logical_not && is_truth(graph[operand(graph, a)].op)) {
        return operand(graph, a);
      }
      return {};
    default:
      return {};
  }
}

Found sum(Graph& graph, Node a, Node b) {
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    if (is(graph, other, -0.0) || (is(graph, other, 0.0) && never_minus_zero(graph, one))) {
      return one;
    }
  }
  if (is(graph, b, Op::neg)) return graph.binary(Op::sub, a, operand(graph, b));
  if (is(graph, a, Op::neg)) return graph.binary(Op::sub, b, operand(graph, a));
  return {};
}

Found difference(Graph& graph, Node a, Node b) {
  if (is(graph, b, 0.0) || (is(graph, b, -0.0) && never_minus_zero(graph, a))) return a;
  if (is(graph, a, -0.0)) return graph.unary(Op::neg, b);
  if (is(graph, b, Op::neg)) return graph.binary(Op::add, a, operand(graph, b));
  return {};
}

Found product(Graph& graph, Node a, Node b) {
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    if (is(graph, other, 1.0)) return one;
    if (is(graph, other, -1.0)) return graph.unary(Op::neg, one);
    const auto number = graph.value(other);  // -a*2 is a*-2
    if (number && is(graph, one, Op::neg)) {
      return graph.binary(Op::mul, operand(graph, one), graph.constant(-*number));
    }
  }
  if (is(graph, a, Op::neg) && is(graph, b, Op::neg)) {
    return graph.binary(Op::mul, operand(graph, a), operand(graph, b));
  }
  return {};
}

/// A quotient by a power of two is a product with its inverse: both round the same number.
Found quotient(Graph& graph, Node a, Node b) {
  const auto number = graph.value(b);
  if (!number) return {};
  int exponent = 0;
  const bool power = std::isnormal(*number) && std::fabs(std::frexp(*number, &exponent)) == 0.5;
  if (!power || !std::isnormal(1.0 / *number)) return {};
  return graph.binary(Op::mul, a, graph.constant(1.0 / *number));
}

/// The powers 2, 0.5 and -1 are computed as for NumPy's arrays; see Graph for 3 and 4.
Found power(Graph& graph, Node a, Node b) {
  const auto number = graph.value(b);
  if (!number) return {};
  const auto square = [&] { return graph.binary(Op::mul, a, a); };
  if (*number == 0.0) return graph.constant(1.0);  // even of NaN, as std::pow
  if (*number == 0.5) return graph.unary(Op::sqrt, a);
  if (*number == 1.0) return a;
  if (*number == -1.0) return graph.binary(Op::div, graph.constant(1.0), a);
  if (*number == 2.0) return square();
  if (*number == 3.0) return graph.binary(Op::mul, square(), a);
  if (*number == 4.0) return graph.binary(Op::mul, square(), square());
  return {};
}

Found conjunction(Graph& graph, Op op, Node a, Node b) {
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    const auto number = graph.value(other);
    if (!number) continue;
    if ((*number != 0.0) == (op == Op::logical_or)) return graph.constant(op == Op::logical_or);
    if (is_truth(graph[one].op)) return one;
  }
  return a == b && is_truth(graph[a].op) ? Found(a) : Found();
}

Found of_two(Graph& graph, Op op, Node a, Node b) {
  switch (op) {
    case Op::add:
      return sum(graph, a, b);
    case Op::sub:
      return difference(graph, a, b);
    case Op::mul:
      return product(graph, a, b);
    case Op::div:
      return quotient(graph, a, b);
    case Op::pow:
      return power(graph, a, b);
    case Op::minimum:
    case Op::maximum:
      return a == b ? Found(a) : Found();
    case Op::lt:
      return a == b ? Found(graph.constant(0.0)) : Found();
    case Op::gt:
      return graph.binary(Op::lt, b, a);
    case Op::ge:
      return graph.binary(Op::le, b, a);
    case Op::logical_and:
    case Op::logical_or:
      return conjunction(graph, op, a, b);
    default:
      return {};
  }
}

Found choice(Graph& graph, Node c, Node a, Node b) {
  if (const auto number = graph.value(c)) return *number != 0.0 ? a : b;
  if (a == b) return a;
  if (is(graph, c, Op::logical_not)) return graph.select(operand(graph, c), b, a);
  if (is_truth(graph[c].op) && is(graph, a, 1.0) && is(graph, b, 0.0)) return c;
  return {};
}

}  // namespace

Found simplified(Graph& graph, Op op, Operands operands) {
  if (operands.size() == 1) return of_one(graph, op, operands[0]);
  if (operands.size() == 2) return of_two(graph, op, operands[0], operands[1]);
  return choice(graph, operands[0], operands[1], operands[2]);
}

}  // namespace saltus::tape
