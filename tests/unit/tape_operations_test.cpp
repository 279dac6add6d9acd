// Each operation against <cmath>, to the last bit, with zeros, infinities and NaN.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "support/catch.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> samples() {
  std::vector<double> all = {0.0,    -0.0, infinity, -infinity, quiet_nan, 5e-324, -5e-324, 1e308,
                             -1e308, 0.5,  -0.5,     1.5,       2.5,       -1.5,   1.0,     -1.0};
  for (double a = -3.3; a < 12.0; a += 0.71) all.push_back(a);
  return all;
}

using One = std::function<double(double)>;
using Two = std::function<double(double, double)>;

double truth(bool value) { return value ? 1.0 : 0.0; }

/// numpy.remainder as its documentation says it: the sign of b, and a - b*floor(a/b) where that is
/// exact.
double mod(double a, double b) {
  double rest = std::fmod(a, b);
  if (std::isnan(rest)) return quiet_nan;
  if (rest != 0.0 && std::signbit(rest) != std::signbit(b)) rest += b;
  return rest == 0.0 ? std::copysign(0.0, b) : rest;
}

const std::vector<std::pair<Op, One>> of_one = {
    {Op::neg, [](double a) { return -a; }},
    {Op::abs, [](double a) { return std::abs(a); }},
    {Op::sqrt, [](double a) { return std::sqrt(a); }},
    {Op::cbrt, [](double a) { return std::cbrt(a); }},
    {Op::exp, [](double a) { return std::exp(a); }},
    {Op::exp2, [](double a) { return std::exp2(a); }},
    {Op::expm1, [](double a) { return std::expm1(a); }},
    {Op::log, [](double a) { return std::log(a); }},
    {Op::log2, [](double a) { return std::log2(a); }},
    {Op::log10, [](double a) { return std::log10(a); }},
    {Op::log1p, [](double a) { return std::log1p(a); }},
    {Op::sin, [](double a) { return std::sin(a); }},
    {Op::cos, [](double a) { return std::cos(a); }},
    {Op::tan, [](double a) { return std::tan(a); }},
    {Op::asin, [](double a) { return std::asin(a); }},
    {Op::acos, [](double a) { return std::acos(a); }},
    {Op::atan, [](double a) { return std::atan(a); }},
    {Op::sinh, [](double a) { return std::sinh(a); }},
    {Op::cosh, [](double a) { return std::cosh(a); }},
    {Op::tanh, [](double a) { return std::tanh(a); }},
    {Op::asinh, [](double a) { return std::asinh(a); }},
    {Op::acosh, [](double a) { return std::acosh(a); }},
    {Op::atanh, [](double a) { return std::atanh(a); }},
    {Op::floor, [](double a) { return std::floor(a); }},
    {Op::ceil, [](double a) { return std::ceil(a); }},
    {Op::trunc, [](double a) { return std::trunc(a); }},
    {Op::rint, [](double a) { return std::rint(a); }},
    {Op::sign,
     [](double a) { return std::isnan(a) ? quiet_nan : truth(a > 0.0) - truth(a < 0.0); }},
    {Op::logical_not, [](double a) { return truth(!static_cast<bool>(a)); }},
};

const std::vector<std::pair<Op, Two>> of_two = {
    {Op::add, [](double a, double b) { return a + b; }},
    {Op::sub, [](double a, double b) { return a - b; }},
    {Op::mul, [](double a, double b) { return a * b; }},
    {Op::div, [](double a, double b) { return a / b; }},
    {Op::pow, [](double a, double b) { return std::pow(a, b); }},
    {Op::atan2, [](double a, double b) { return std::atan2(a, b); }},
    {Op::hypot, [](double a, double b) { return std::hypot(a, b); }},
    {Op::copysign, [](double a, double b) { return std::copysign(a, b); }},
    {Op::mod, mod},
    {Op::fmod, [](double a, double b) { return std::fmod(a, b); }},
    {Op::lt, [](double a, double b) { return truth(a < b); }},
    {Op::le, [](double a, double b) { return truth(a <= b); }},
    {Op::gt, [](double a, double b) { return truth(a > b); }},
    {Op::ge, [](double a, double b) { return truth(a >= b); }},
    {Op::eq, [](double a, double b) { return truth(a == b); }},
    {Op::ne, [](double a, double b) { return truth(a != b); }},
    {Op::logical_and, [](double a, double b) { return truth(a && b); }},
    {Op::logical_or, [](double a, double b) { return truth(a || b); }},
};

bool rounded_power(double exponent) {
  return std::ranges::count(std::array{1.5, 2.5, -0.5, -1.5, -2.0, -3.0}, exponent) > 0;
}

}  // namespace

TEST_CASE("operations of one operand are those of <cmath>", "[tape]") {
  REQUIRE(static_cast<int>(of_one.size()) ==
          static_cast<int>(Op::logical_not) - static_cast<int>(Op::neg) + 1);
  for (const auto& [op, expected] : of_one) {
    Graph g;
    const Tape tape = tape_of(g, {g.unary(op, g.continuous_state(0))});
    for (const double a : samples()) {
      INFO(name(op) << " of " << a);
      CHECK(same_bits(values_of(tape, {.x = {a}})[0], expected(a)));
      CHECK(same_bits(*g.value(g.unary(op, g.constant(a))), expected(a)));
    }
  }
}

TEST_CASE("operations of two operands are those of <cmath>", "[tape]") {
  for (const auto& [op, expected] : of_two) {
    Graph g;
    const Tape tape = tape_of(g, {g.binary(op, g.continuous_state(0), g.parameter(0))});
    for (const double a : samples()) {
      for (const double b : samples()) {
        if (op == Op::pow && rounded_power(b)) continue;  // see Graph
        INFO(name(op) << " of " << a << " and " << b);
        CHECK(same_bits(values_of(tape, {.x = {a}, .p = {b}})[0], expected(a, b)));
      }
    }
  }
}

TEST_CASE("minimum and maximum let NaN through", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1);
  const Tape tape = tape_of(g, {g.binary(Op::minimum, x, y), g.binary(Op::maximum, x, y)});
  CHECK(values_of(tape, {.x = {1.0, -2.0}}) == std::vector{-2.0, 1.0});
  CHECK(values_of(tape, {.x = {-infinity, 3.0}}) == std::vector{-infinity, 3.0});
  for (const auto& x0 : {std::vector{quiet_nan, 1.0},
                         {1.0, quiet_nan},
                         {quiet_nan, infinity},
                         {quiet_nan, quiet_nan}}) {
    for (const double value : values_of(tape, {.x = x0})) CHECK(std::isnan(value));
  }
}

TEST_CASE("// and % are Python's: a is b * (a // b) + a % b", "[tape]") {
  Graph g;
  const Node a = g.continuous_state(0), b = g.continuous_state(1);
  const Tape tape = tape_of(g, {g.binary(Op::floor_divide, a, b), g.binary(Op::mod, a, b)});
  const auto of = [&](double x, double y) { return values_of(tape, {.x = {x, y}}); };
  CHECK(of(7.0, 2.0) == std::vector{3.0, 1.0});
  CHECK(of(-7.0, 2.0) == std::vector{-4.0, 1.0});
  CHECK(of(7.0, -2.0) == std::vector{-4.0, -1.0});
  CHECK(of(-7.0, -2.0) == std::vector{3.0, -1.0});
  CHECK(of(1.0, 0.1)[0] == 9.0);                     // 0.1 is a little more than a tenth
  CHECK(of(-1e-20, 3.0) == std::vector{-1.0, 3.0});  // as Python: -1e-20 + 3 rounds to 3
  CHECK(of(1.0, 0.0)[0] == infinity);
  CHECK(of(-1.0, 0.0)[0] == -infinity);
  CHECK(std::isnan(of(0.0, 0.0)[0]));
  CHECK(std::isnan(of(1.0, 0.0)[1]));
  CHECK(same_bits(of(-0.0, 3.0)[0], -0.0));
}

TEST_CASE("select takes the one it names, and NaN is true", "[tape]") {
  Graph g;
  const Tape tape =
      tape_of(g, {g.select(g.continuous_state(0), g.continuous_state(1), g.continuous_state(2))});
  CHECK(values_of(tape, {.x = {1.0, 5.0, quiet_nan}})[0] == 5.0);
  CHECK(values_of(tape, {.x = {0.0, quiet_nan, 6.0}})[0] == 6.0);
  CHECK(values_of(tape, {.x = {-0.0, 5.0, 6.0}})[0] == 6.0);
  CHECK(values_of(tape, {.x = {quiet_nan, 5.0, 6.0}})[0] == 5.0);
}
