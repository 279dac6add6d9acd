// Operations that are not smooth: the branch that a series takes, and how they are found.
#include "support/catch.hpp"
#include "support/series_world.hpp"

using namespace saltus::tape;
using namespace support;

TEST_CASE("at a kink the branch is that of the time just after it") {
  CHECK(along([](Graph& g, Node x) { return g.unary(Op::abs, x); }, 0.0, 2) == Numbers{0, 1, 0});
  const Numbers back = along(
      [](Graph& g, Node x) { return g.unary(Op::abs, g.binary(Op::mul, g.constant(-2.0), x)); },
      0.0, 2);
  CHECK(back == Numbers{0, 2, 0});
  const Numbers square = along(
      [](Graph& g, Node x) {  // |-x^2|
        return g.unary(Op::abs, g.unary(Op::neg, g.binary(Op::mul, x, x)));
      },
      0.0, 5);
  CHECK(square == Numbers{0, 0, 1, 0, 0, 0});
  const Numbers least = along(
      [](Graph& g, Node x) { return g.binary(Op::minimum, g.binary(Op::mul, x, x), x); }, 0.0, 3);
  CHECK(least == Numbers{0, 0, 1, 0});
  const Numbers most = along(
      [](Graph& g, Node x) { return g.binary(Op::maximum, g.binary(Op::mul, x, x), x); }, 0.0, 3);
  CHECK(most == Numbers{0, 1, 0, 0});
  const Numbers chosen = along(
      [](Graph& g, Node x) {  // x > 0 ? 3 x : x
        const Node c = g.binary(Op::gt, x, g.constant(0.0));
        return g.select(c, g.binary(Op::mul, g.constant(3.0), x), x);
      },
      0.0, 2);
  CHECK(chosen == Numbers{0, 3, 0});
  const Numbers jump = along(
      [](Graph& g, Node x) {  // x > 0 ? x + 1 : 2 x: not continuous
        const Node c = g.binary(Op::gt, x, g.constant(0.0));
        return g.select(c, g.binary(Op::add, g.constant(1.0), x),
                        g.binary(Op::mul, g.constant(2.0), x));
      },
      0.0, 2);
  CHECK(jump == Numbers{0, 2, 0});  // the branch of the value
}

TEST_CASE("remainders are linear between their jumps, steps are constant") {
  const auto rest = [](Op op, double at) {
    Graph g;
    const Node x = g.continuous_state(0);
    Series series(
        g, std::array{g.constant(1.0)},
        std::array{g.binary(
            op, x, g.binary(Op::add, g.constant(1.0), g.binary(Op::mul, g.constant(0.125), x)))});
    expanded(series, {.x = {at}}, 2);
    return outputs_of(series, 2);
  };
  CHECK(rest(Op::mod, 4.0) == Numbers{1.0, 0.75, 0.0});     // 4 mod 1.5, quotient 2
  CHECK(rest(Op::fmod, -4.0) == Numbers{0.0, 2.0, 0.0});    // -4 = -8 * 0.5
  CHECK(rest(Op::mod, -2.0) == Numbers{0.25, 1.375, 0.0});  // -2 mod 0.75, quotient -3
  CHECK(rest(Op::fmod, -2.0) == Numbers{-0.5, 1.25, 0.0});  // quotient -2
  CHECK(rest(Op::floor_divide, 4.0) == Numbers{2.0, 0.0, 0.0});
}

TEST_CASE("kinks are found where an operand varies, and nowhere else") {
  for (int o = static_cast<int>(Op::neg); o < operation_count; ++o) {
    const Op op = static_cast<Op>(o);
    Graph g;
    const auto made = [&](Node a, Node b) {
      if (operand_count(op) == 1) return g.unary(op, a);
      if (operand_count(op) == 2) return g.binary(op, a, b);
      return g.select(a, b, g.constant(2.0));
    };
    const bool known = op == Op::abs || (op >= Op::floor && op <= Op::logical_not) ||
                       (op >= Op::copysign && op <= Op::select);
    const Op reported = op == Op::gt ? Op::lt : op == Op::ge ? Op::le : op;  // as a graph has them
    const std::vector<Op> expected = known ? std::vector{reported} : std::vector<Op>{};
    INFO(name(op));
    const Node p = g.parameter(0), u = g.input(0, 0);
    CHECK(kinks(g, std::array{made(p, u)}).empty());
    CHECK(kinks(g, std::array{made(g.discrete_state(0), g.mode())}).empty());
    for (const Node varying : {g.time(), g.continuous_state(0), g.unary(Op::sin, g.time())}) {
      CHECK(kinks(g, std::array{g.unary(Op::exp, made(varying, p))}) == expected);
      // a select between values that vary, by a condition that does not, has one branch
      const bool chosen = op == Op::select;
      if (operand_count(op) > 1)
        CHECK(kinks(g, std::array{made(p, varying)}) == (chosen ? std::vector<Op>{} : expected));
    }
  }
}

TEST_CASE("kinks are listed once, in the order of the operations") {
  Graph g;
  const Node x = g.continuous_state(0);
  const Node a = g.unary(Op::abs, x), b = g.unary(Op::abs, g.unary(Op::neg, g.unary(Op::exp, x)));
  const Node both = g.binary(Op::minimum, a, b);
  CHECK(kinks(g, std::array{both, a}) == std::vector{Op::abs, Op::minimum});
  CHECK(kinks(g, {}).empty());
}
