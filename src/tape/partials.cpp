#include "partials.hpp"

#include <cmath>
#include <numbers>

namespace saltus::tape {

namespace {

/// Short names for building expressions.
struct Terms {
  Graph& graph;
  Node n(double value) { return graph.constant(value); }
  Node add(Node a, Node b) { return graph.binary(Op::add, a, b); }
  Node sub(Node a, Node b) { return graph.binary(Op::sub, a, b); }
  Node mul(Node a, Node b) { return graph.binary(Op::mul, a, b); }
  Node div(Node a, Node b) { return graph.binary(Op::div, a, b); }
  Node neg(Node a) { return graph.unary(Op::neg, a); }
  Node of(Op op, Node a) { return graph.unary(op, a); }
  Node of(Op op, Node a, Node b) { return graph.binary(op, a, b); }
  Node square(Node a) { return mul(a, a); }
  Node inverse(Node a) { return div(n(1.0), a); }
  /// 1 - a^2 without cancellation near 1.
  Node one_less_square(Node a) { return mul(sub(n(1.0), a), add(n(1.0), a)); }
  Node unless_zero(Node a, Node value) {
    return graph.select(of(Op::eq, a, n(0.0)), n(0.0), value);
  }
};

std::optional<Node> of_one(Terms w, Op op, Node a, Node value) {
  switch (op) {
    case Op::neg:
      return w.n(-1.0);
    case Op::abs:
      return w.of(Op::sign, a);
    case Op::sqrt:
      return w.div(w.n(0.5), value);
    case Op::cbrt:
      return w.div(w.n(1.0 / 3.0), w.square(value));
    case Op::exp:
      return value;
    case Op::exp2:
      return w.mul(w.n(std::numbers::ln2), value);
    case Op::expm1:
      return w.of(Op::exp, a);
    case Op::log:
      return w.inverse(a);
    case Op::log2:
      return w.div(w.n(std::numbers::log2e), a);
    case Op::log10:
      return w.div(w.n(std::numbers::log10e), a);
    case Op::log1p:
      return w.inverse(w.add(w.n(1.0), a));
    case Op::sin:
      return w.of(Op::cos, a);
    case Op::cos:
      return w.neg(w.of(Op::sin, a));
    case Op::tan:
      return w.add(w.n(1.0), w.square(value));
    case Op::asin:
      return w.inverse(w.of(Op::sqrt, w.one_less_square(a)));
    case Op::acos:
      return w.div(w.n(-1.0), w.of(Op::sqrt, w.one_less_square(a)));
    case Op::atan:
      return w.inverse(w.add(w.n(1.0), w.square(a)));
    case Op::sinh:
      return w.of(Op::cosh, a);
    case Op::cosh:
      return w.of(Op::sinh, a);
    case Op::tanh:
      return w.one_less_square(value);
    case Op::asinh:
      return w.inverse(w.of(Op::hypot, a, w.n(1.0)));
    case Op::acosh:  // not sqrt(a^2 - 1), which cancels near 1
      return w.inverse(
          w.mul(w.of(Op::sqrt, w.sub(a, w.n(1.0))), w.of(Op::sqrt, w.add(a, w.n(1.0)))));
    case Op::atanh:
      return w.inverse(w.one_less_square(a));
    default:
      return {};
  }
}

std::optional<Node> of_power(Terms w, Node a, Node b, Node value, bool first) {
  if (!first) return w.unless_zero(a, w.mul(value, w.of(Op::log, a)));
  const Node rest = w.of(Op::pow, a, w.sub(b, w.n(1.0)));
  return w.unless_zero(b, w.mul(b, rest));
}

std::optional<Node> of_two(Terms w, Op op, Node a, Node b, Node value, bool first) {
  switch (op) {
    case Op::add:
      return w.n(1.0);
    case Op::sub:
      return w.n(first ? 1.0 : -1.0);
    case Op::mul:
      return first ? b : a;
    case Op::div:
      return first ? w.inverse(b) : w.neg(w.mul(value, w.inverse(b)));
    case Op::pow:
      return of_power(w, a, b, value, first);
    case Op::atan2: {
      const Node square = w.add(w.square(a), w.square(b));
      return first ? w.div(b, square) : w.neg(w.div(a, square));
    }
    case Op::hypot:
      return w.unless_zero(value, w.div(first ? a : b, value));
    case Op::copysign:
      if (!first) return {};
      return w.mul(w.of(Op::sign, a), w.of(Op::copysign, w.n(1.0), b));
    case Op::mod:
    case Op::fmod:  // value = a - b * k with a whole number k
      return first ? w.n(1.0) : w.of(Op::rint, w.div(w.sub(value, a), b));
    default:
      return {};
  }
}

}  // namespace

std::optional<Node> partial(Graph& graph, Node node, std::size_t k) {
  const Expression e = graph[node];  // a copy: the graph grows
  const Terms w{graph};
  if (operand_count(e.op) == 1) return of_one(w, e.op, e.operands[0], node);
  return of_two(w, e.op, e.operands[0], e.operands[1], node, k == 0);
}

}  // namespace saltus::tape
