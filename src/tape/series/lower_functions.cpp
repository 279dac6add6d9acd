// Powers and the functions of <cmath>.
#include <cmath>
#include <numbers>

#include "lower.hpp"

namespace saltus::tape::series {

Index Lowering::lower_power(Node node, Node a, Node b) {
  constexpr double most_factors = 16.0;
  if (row(b) == zero_row) {
    const auto p = graph_.value(b);
    const bool whole = p && *p >= 2.0 && *p <= most_factors && std::floor(*p) == *p;
    if (whole) return lower_whole_power(a, static_cast<int>(*p));
    const Index to = new_row();
    return add(power, {.to = to,
                       .a = row(a),
                       .da = slope(row(a)),
                       .db = slope(to),
                       .value = node.id,
                       .of_a = a.id,
                       .of_b = b.id});
  }
  // of a constant base 0 the logarithm is not needed: the power is 0
  Node log = of(Op::log, a);
  if (known(a) == zero_row) log = graph_.select(of(Op::eq, a, n(0.0)), n(0.0), log);
  return lower_growth(node, times(b, log), 1.0, node);
}

Index Lowering::lower_whole_power(Node a, int exponent) {
  std::optional<Node> result;
  for (Node factor = a; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result = result ? times(*result, factor) : factor;
    if (exponent > 1) factor = times(factor, factor);
  }
  return row(*result);
}

Index Lowering::lower_growth(Node node, Node a, double factor, Node b) {
  const Index of_a = row(a), to = known(node) = new_row();
  const std::size_t place = program_.instructions.size();
  add(growth, {.to = to, .a = of_a, .da = slope(of_a), .of_b = b.id, .factor = factor});
  const Index of_b = row(b);  // it may depend on the result
  program_.instructions[place].b = of_b;
  return to;
}

Index Lowering::lower_logarithm(Node a, double factor, Node b) {
  const Index of_b = row(b), to = new_row();
  return add(logarithm,
             {.to = to, .a = row(a), .b = of_b, .db = slope(to), .of_b = b.id, .factor = factor});
}

Index Lowering::lower_angle(Node a, Node b) {
  const Index of_a = row(a), of_b = row(b);
  const Node distance = sum_of_squares(a, b);
  const Index of_distance = row(distance);
  const Index integrand =
      add(turn,
          {.a = of_a, .b = of_b, .da = slope(of_a), .db = slope(of_b), .of_a = a.id, .of_b = b.id});
  const Index to = new_row();
  return add(angle,
             {.to = to, .a = integrand, .b = of_distance, .db = slope(to), .of_b = distance.id});
}

Index Lowering::lower_rotation(Node node, Op sine, Op cosine, Node a, double factor) {
  const Node s = of(sine, a), c = of(cosine, a);
  const Index to = known(s) = new_row(), second = known(c) = new_row();
  add(rotation, {.to = to,
                 .to_second = second,
                 .a = row(a),
                 .da = slope(row(a)),
                 .value = s.id,
                 .of_b = c.id,
                 .factor = factor});
  return known(node);
}

Index Lowering::lower_unary(Node node, const Expression& e) {
  const Node a = e.operands[0], one = n(1.0);
  const auto one_less_square = [&] { return times(of(Op::sub, one, a), of(Op::add, one, a)); };
  switch (e.op) {
    case Op::neg:
      return keep(node, scaled(form(a), n(-1.0)));
    case Op::sqrt:
      return add(root, {.a = row(a), .value = node.id});
    case Op::cbrt:
      return lower_power(node, a, n(1.0 / 3.0));
    case Op::exp:
      return lower_growth(node, a, 1.0, node);
    case Op::exp2:
      return lower_growth(node, a, std::numbers::ln2, node);
    case Op::expm1:
      return lower_growth(node, a, 1.0, of(Op::add, node, one));
    case Op::log:
      return lower_logarithm(a, 1.0, a);
    case Op::log2:
      return lower_logarithm(a, std::numbers::log2e, a);
    case Op::log10:
      return lower_logarithm(a, std::numbers::log10e, a);
    case Op::log1p:
      return lower_logarithm(a, 1.0, of(Op::add, one, a));
    case Op::sin:
    case Op::cos:
      return lower_rotation(node, Op::sin, Op::cos, a, -1.0);
    case Op::sinh:
    case Op::cosh:
      return lower_rotation(node, Op::sinh, Op::cosh, a, 1.0);
    case Op::tan:
      return lower_growth(node, a, 1.0, of(Op::add, one, times(node, node)));
    case Op::tanh:
      return lower_growth(node, a, 1.0, of(Op::sub, one, times(node, node)));
    case Op::asin:
      return lower_logarithm(a, 1.0, of(Op::sqrt, one_less_square()));
    case Op::acos:
      return lower_logarithm(a, -1.0, of(Op::sqrt, one_less_square()));
    case Op::atan:
      return lower_logarithm(a, 1.0, of(Op::add, one, times(a, a)));
    case Op::asinh:
      return lower_logarithm(a, 1.0, of(Op::hypot, a, one));
    case Op::acosh:
      return lower_logarithm(a, 1.0, of(Op::sqrt, times(of(Op::sub, a, one), of(Op::add, a, one))));
    default:
      return lower_logarithm(a, 1.0, one_less_square());  // atanh
  }
}

}  // namespace saltus::tape::series
