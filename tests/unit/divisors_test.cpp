// What expressions divide by, where it may change its sign.
#include "saltus/tape/divisors.hpp"

#include <array>

#include "support/catch.hpp"

using namespace saltus::tape;

namespace {

struct World {
  Graph g;
  Node t = g.time(), x = g.continuous_state(0), p = g.parameter(0);
  Node c(double value) { return g.constant(value); }
  Node operator()(Op op, Node a) { return g.unary(op, a); }
  Node operator()(Op op, Node a, Node b) { return g.binary(op, a, b); }
  std::vector<Node> of(Node node) { return divisors(g, std::array{node}); }
  std::vector<Node> of_quotient(Node divisor) { return of(g.binary(Op::div, x, divisor)); }
};

}  // namespace

TEST_CASE("a divisor of the time is found wherever it is") {
  World w;
  const Node d = w(Op::sub, w.c(0.5), w.t), e = w(Op::sin, w.x);
  CHECK(w.of_quotient(d) == std::vector{d});
  CHECK(w.of(w(Op::exp, w(Op::div, w.c(2.0), w(Op::neg, d)))) == std::vector{d});
  CHECK(w.of_quotient(w(Op::mul, d, d)) == std::vector{d});
  CHECK(w.of_quotient(w(Op::mul, w(Op::mul, d, e), w.p)) == std::vector{d});
  CHECK(w.of_quotient(w(Op::abs, d)) == std::vector{d});
  CHECK(w.of_quotient(w(Op::pow, d, w.c(5.0))) == std::vector{d});
  CHECK(w.of(w(Op::pow, d, w.c(-3.0))) == std::vector{d});
  CHECK(w.of(w(Op::pow, d, w.p)) == std::vector{d});
  CHECK(w.of_quotient(w(Op::div, d, e)) == std::vector{d});
  CHECK(w.of(w(Op::tan, d)) == std::vector{w(Op::cos, d)});
}

TEST_CASE("a divisor that is constant, keeps its sign, or reads a state, is left out") {
  World w;
  const Node square = w(Op::mul, w.t, w.t);
  CHECK(w.of_quotient(w.x).empty());
  CHECK(w.of_quotient(w(Op::sub, w.x, w.t)).empty());
  CHECK(w.of_quotient(w.p).empty());
  CHECK(w.of_quotient(w(Op::sin, w.p)).empty());
  CHECK(w.of(w(Op::pow, w.x, w.c(3.0))).empty());
  CHECK(w.of(w(Op::tan, w.p)).empty());
  CHECK(w.of_quotient(w(Op::add, w.c(1.0), square)).empty());
  CHECK(w.of_quotient(w(Op::sqrt, w.t)).empty());
  CHECK(w.of_quotient(w(Op::exp, w.t)).empty());
  CHECK(w.of_quotient(w(Op::mul, w.c(2.0), w(Op::cosh, w.t))).empty());
  CHECK(w.of(w(Op::pow, w(Op::add, square, w(Op::mul, w.t, w.t)), w.c(-1.5))).empty());
  CHECK(w.of_quotient(w(Op::add, w.c(-1.0), square)).size() == 1);
  CHECK(w.of_quotient(w(Op::add, w.c(2.0), w(Op::sin, w.t))).empty());
  CHECK(w.of_quotient(w(Op::add, w.c(0.9), w(Op::cos, w.t))).size() == 1);
  CHECK(w.of_quotient(w(Op::sub, w.c(-1.5), w(Op::tanh, w.t))).empty());
  CHECK(w.of_quotient(w(Op::maximum, w.t, w.c(1e-9))).empty());
}

TEST_CASE("a divisor is read once, however often it is a factor") {
  World w;
  Node power = w(Op::sub, w.c(0.5), w.t);  // the 2^60th power, by squares
  const Node base = power;
  for (int i = 0; i < 60; ++i) power = w(Op::mul, power, power);
  CHECK(w.of_quotient(power) == std::vector{base});
}
