// Equal expressions are one node, constants are folded, and what is made shorter keeps every bit.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;
using Catch::Matchers::Contains;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> edges = {0.0,    -0.0,   1.0,   -1.0,     0.5,       -2.5,     3.0,
                                   1e-310, -1e300, 1e300, infinity, -infinity, quiet_nan};

/// The value of a node of one variable x[0].
double value_at(const Graph& graph, Node node, double x) {
  return values_of(tape_of(graph, {node}), {.x = {x}})[0];
}

}  // namespace

TEST_CASE("equal expressions are one node", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1);
  CHECK(g.continuous_state(0) == x);
  CHECK(x != y);
  CHECK(g.discrete_state(0) != x);
  CHECK(g.input(0, 1) != g.input(1, 0));
  CHECK(g.binary(Op::add, x, y) == g.binary(Op::add, y, x));
  CHECK(g.binary(Op::mul, x, y) == g.binary(Op::mul, y, x));
  CHECK(g.binary(Op::sub, x, y) != g.binary(Op::sub, y, x));
  CHECK(g.binary(Op::gt, x, y) == g.binary(Op::lt, y, x));
  CHECK(g.binary(Op::ge, x, y) == g.binary(Op::le, y, x));
  CHECK(g.unary(Op::sin, g.binary(Op::add, x, y)) == g.unary(Op::sin, g.binary(Op::add, y, x)));
}

TEST_CASE("constants are told apart by their bits", "[tape]") {
  Graph g;
  CHECK(g.constant(2.0) == g.constant(2.0));
  CHECK(g.constant(0.0) != g.constant(-0.0));
  CHECK(g.constant(quiet_nan) == g.constant(quiet_nan));
}

TEST_CASE("what has constants only is computed at once", "[tape]") {
  Graph g;
  const Node sum = g.binary(Op::add, g.constant(0.1), g.constant(0.2));
  CHECK(same_bits(*g.value(sum), 0.1 + 0.2));
  CHECK(same_bits(*g.value(g.unary(Op::sin, g.constant(0.7))), std::sin(0.7)));
  CHECK(
      same_bits(*g.value(g.binary(Op::pow, g.constant(1.1), g.constant(3.0))), std::pow(1.1, 3.0)));
  CHECK(!g.value(g.continuous_state(0)));
}

TEST_CASE("identities make an expression shorter and keep every bit", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0);
  const auto n = [&](double value) { return g.constant(value); };
  const auto make = [&](Op op, Node a, Node b) { return g.binary(op, a, b); };
  const Node minus = g.unary(Op::neg, x), half = make(Op::mul, x, n(0.5));
  CHECK(make(Op::mul, x, n(1.0)) == x);
  CHECK(make(Op::mul, n(-1.0), x) == minus);
  CHECK(make(Op::div, x, n(1.0)) == x);
  CHECK(make(Op::div, x, n(2.0)) == half);
  CHECK(make(Op::div, x, n(-2.0)) == make(Op::mul, x, n(-0.5)));
  CHECK(make(Op::sub, x, n(0.0)) == x);
  CHECK(make(Op::add, x, n(-0.0)) == x);
  CHECK(make(Op::sub, n(-0.0), x) == minus);
  CHECK(g.unary(Op::neg, minus) == x);
  CHECK(g.unary(Op::abs, minus) == g.unary(Op::abs, x));
  CHECK(make(Op::add, n(3.0), minus) == make(Op::sub, n(3.0), x));
  CHECK(make(Op::sub, n(3.0), minus) == make(Op::add, n(3.0), x));
  CHECK(make(Op::mul, minus, n(3.0)) == make(Op::mul, x, n(-3.0)));
  CHECK(make(Op::lt, x, x) == n(0.0));
  CHECK(make(Op::minimum, x, x) == x);
  const Node square = make(Op::mul, x, x);
  CHECK(make(Op::add, square, n(0.0)) == square);  // x*x is never -0
  CHECK(g.select(n(1.0), x, minus) == x);
  CHECK(g.select(n(quiet_nan), x, minus) == x);
  CHECK(g.select(n(0.0), x, minus) == minus);
  CHECK(g.select(minus, x, x) == x);
}

TEST_CASE("what would change a bit is left as it is", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0);
  const auto stays = [&](Op op, double a, double expected_at, double expected) {
    const Node node = g.binary(op, x, g.constant(a));
    CHECK(node != x);
    CHECK(same_bits(value_at(g, node, expected_at), expected));
  };
  stays(Op::add, 0.0, -0.0, 0.0);
  stays(Op::mul, 0.0, infinity, quiet_nan);
  stays(Op::mul, 0.0, -1.0, -0.0);
  stays(Op::div, 3.0, 1.0, 1.0 / 3.0);
  stays(Op::div, 1e-310, 1e-5, 1e-5 / 1e-310);
  CHECK(same_bits(value_at(g, g.binary(Op::sub, x, x), infinity), quiet_nan));
  CHECK(same_bits(value_at(g, g.binary(Op::div, x, x), 0.0), quiet_nan));
  CHECK(value_at(g, g.binary(Op::eq, x, x), quiet_nan) == 0.0);
  CHECK(value_at(g, g.unary(Op::logical_not, g.binary(Op::lt, x, g.constant(0.0))), quiet_nan) ==
        1.0);
}

TEST_CASE("every operation beside every special constant is what <cmath> says", "[tape]") {
  // The same operation with both operands variable is not made shorter: both must agree.
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1);
  for (int op = static_cast<int>(Op::add); op < operation_count - 1; ++op) {
    const auto operation = static_cast<Op>(op);
    const Tape plain = tape_of(g, {g.binary(operation, x, y)});
    for (const double c : edges) {
      const bool rounded = operation == Op::pow && (c == 0.5 || c == 3.0);  // see Graph
      if (rounded) continue;
      const Tape left = tape_of(g, {g.binary(operation, g.constant(c), x)});
      const Tape right = tape_of(g, {g.binary(operation, x, g.constant(c))});
      for (const double a : edges) {
        INFO(name(operation) << " of " << a << " and " << c);
        CHECK(same_bits(values_of(left, {.x = {a}})[0], values_of(plain, {.x = {c, a}})[0]));
        CHECK(same_bits(values_of(right, {.x = {a}})[0], values_of(plain, {.x = {a, c}})[0]));
      }
    }
  }
}

TEST_CASE("small constant powers are products, within half a rounding for each factor", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0);
  const auto power = [&](double exponent, double at) {
    return value_at(g, g.binary(Op::pow, x, g.constant(exponent)), at);
  };
  for (double a = -7.0; a < 7.0; a += 0.37) {
    CHECK(same_bits(power(2.0, a), a * a));
    CHECK(same_bits(power(1.0, a), a));
    CHECK(same_bits(power(-1.0, a), 1.0 / a));
    for (const int exponent : {3, 4}) {
      const long double exact = std::pow(static_cast<long double>(a), exponent);
      // each product rounds by half an epsilon, and x*x counts twice in the fourth power
      const long double most = 0.5 * (exponent - 1) * std::numeric_limits<double>::epsilon();
      const long double error = static_cast<long double>(power(exponent, a)) - exact;
      CHECK(std::fabs(error) <= most * std::fabs(exact));
    }
  }
  CHECK(power(0.0, quiet_nan) == 1.0);
  CHECK(same_bits(power(0.5, 2.0), std::sqrt(2.0)));
  CHECK(same_bits(power(5.0, 1.1), std::pow(1.1, 5.0)));
}

TEST_CASE("what is no operation or no node is refused", "[tape]") {
  Graph g, other;
  const Node x = g.continuous_state(0);
  CHECK_THROWS_WITH(g.unary(Op::add, x), Contains("'add' takes 2 nodes, found 1"));
  CHECK_THROWS_WITH(g.unary(Op::constant, x), Contains("takes 0 nodes"));
  CHECK_THROWS_WITH(g.unary(Op::sin, Node{7}), Contains("no node 7 in this graph of 1 nodes"));
  CHECK_THROWS_WITH(other.value(x), Contains("no node 0"));
  CHECK_THROWS_WITH(g.continuous_state(-1), Contains("continuous_state"));
  CHECK_THROWS_WITH(known_operation("sine"), Contains("did you mean 'sin'?"));
  CHECK(known_operation("floor_divide") == Op::floor_divide);
  CHECK(!operation("sine"));
  const Node foreign{5};
  CHECK_THROWS_AS(tape_of(g, {foreign}), saltus::ModelError);
}

TEST_CASE("powers by products and roots are within half an epsilon for each rounding", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0);
  struct Row {
    double exponent;
    int roundings;
  };
  for (const auto& [exponent, roundings] :
       {Row{1.5, 2}, Row{2.5, 3}, Row{-0.5, 2}, Row{-1.5, 3}, Row{-2.0, 2}, Row{-3.0, 3}}) {
    const auto at = [&, e = exponent](double a) {
      return value_at(g, g.binary(Op::pow, x, g.constant(e)), a);
    };
    for (double a = 1e-20; a < 1e20; a *= 1.37) {
      const long double exact = std::pow(static_cast<long double>(a), exponent);
      const long double most = 0.5 * roundings * std::numeric_limits<double>::epsilon();
      INFO(a << " to the power " << exponent);
      // one more rounding of second order
      CHECK(std::fabs(static_cast<long double>(at(a)) - exact) <= 1.001L * most * exact);
    }
    for (const double a : {0.0, -0.0, 1.0, infinity, quiet_nan, -1.0}) {
      INFO(a << " to the power " << exponent);
      CHECK(same_bits(at(a), std::pow(a, exponent)));
    }
  }
}
