// Derivatives by closed forms, what they are at kinks, and which entries are not there.
#include "saltus/tape/jacobian.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "support/catch.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using Places = std::vector<std::pair<saltus::Index, saltus::Index>>;

Places places(const Jacobian& jacobian) {
  Places all;
  for (const auto& entry : jacobian.entries) all.push_back({entry.row, entry.column});
  return all;
}

/// d(node)/d(x[0]) at a point; 0 where there is no entry.
double slope(const Graph& graph, Node node, const std::vector<double>& x) {
  const Jacobian result = jacobian(tape_of(graph, {node}));
  const auto values = values_of(result.values, {.x = x});
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (result.entries[i].column == 0) return values[i];
  }
  return 0.0;
}

/// An expression of one state.
struct Line {
  Graph g = {};
  Node x = g.continuous_state(0);
  Node n(double value) { return g.constant(value); }
};

}  // namespace

TEST_CASE("derivatives of the operations of one operand", "[tape]") {
  using Exact = std::function<double(double)>;
  const std::vector<std::pair<Op, Exact>> all = {
      {Op::neg, [](double) { return -1.0; }},
      {Op::abs, [](double) { return 1.0; }},
      {Op::sqrt, [](double a) { return 0.5 * std::pow(a, -0.5); }},
      {Op::cbrt, [](double a) { return std::pow(a, -2.0 / 3.0) / 3.0; }},
      {Op::exp, [](double a) { return std::exp(a); }},
      {Op::exp2, [](double a) { return std::log(2.0) * std::exp2(a); }},
      {Op::expm1, [](double a) { return std::exp(a); }},
      {Op::log, [](double a) { return 1.0 / a; }},
      {Op::log2, [](double a) { return 1.0 / (a * std::log(2.0)); }},
      {Op::log10, [](double a) { return 1.0 / (a * std::log(10.0)); }},
      {Op::log1p, [](double a) { return 1.0 / (1.0 + a); }},
      {Op::sin, [](double a) { return std::cos(a); }},
      {Op::cos, [](double a) { return -std::sin(a); }},
      {Op::tan, [](double a) { return std::pow(std::cos(a), -2.0); }},
      {Op::asin, [](double a) { return std::pow(1.0 - a * a, -0.5); }},
      {Op::acos, [](double a) { return -std::pow(1.0 - a * a, -0.5); }},
      {Op::atan, [](double a) { return 1.0 / (1.0 + a * a); }},
      {Op::sinh, [](double a) { return std::cosh(a); }},
      {Op::cosh, [](double a) { return std::sinh(a); }},
      {Op::tanh, [](double a) { return std::pow(std::cosh(a), -2.0); }},
      {Op::asinh, [](double a) { return std::pow(a * a + 1.0, -0.5); }},
      {Op::atanh, [](double a) { return 1.0 / (1.0 - a * a); }},
  };
  for (const auto& [op, exact] : all) {
    Line line;
    for (const double a : {0.1, 0.45, 0.9}) {
      INFO(name(op) << " at " << a);
      // A few roundings each, and 1 - a^2 loses a factor of 5 at 0.9: far below 1e-14.
      CHECK_THAT(slope(line.g, line.g.unary(op, line.x), {a}), WithinRel(exact(a), 1e-14));
    }
  }
  Line line;  // the only one that is not defined there
  CHECK_THAT(slope(line.g, line.g.unary(Op::acosh, line.x), {1.5}),
             WithinRel(1.0 / std::sqrt(1.25), 1e-14));
}

TEST_CASE("derivatives of the operations of two operands", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1);
  const auto check = [&](Op op, double of_x, double of_y) {
    const Jacobian result = jacobian(tape_of(g, {g.binary(op, x, y)}));
    REQUIRE(places(result) == Places{{0, 0}, {0, 1}});
    const auto values = values_of(result.values, {.x = {3.0, 2.0}});
    INFO(name(op));
    CHECK_THAT(values[0], WithinRel(of_x, 1e-15));
    CHECK_THAT(values[1], WithinRel(of_y, 1e-15));
  };
  check(Op::add, 1.0, 1.0);
  check(Op::sub, 1.0, -1.0);
  check(Op::mul, 2.0, 3.0);
  check(Op::div, 0.5, -0.75);
  check(Op::pow, 6.0, 9.0 * std::log(3.0));
  check(Op::atan2, 2.0 / 13.0, -3.0 / 13.0);
  check(Op::hypot, 3.0 / std::sqrt(13.0), 2.0 / std::sqrt(13.0));
  check(Op::mod, 1.0, -1.0);  // 3 % 2 = 3 - 1 * 2
  check(Op::fmod, 1.0, -1.0);
}

TEST_CASE("derivatives at kinks are one-sided as documented", "[tape]") {
  Line l;
  const auto at = [&](Node node, double x) { return slope(l.g, node, {x}); };
  const Node absolute = l.g.unary(Op::abs, l.x);
  CHECK(at(absolute, -2.0) == -1.0);
  CHECK(at(absolute, 0.0) == 0.0);
  const Node least = l.g.binary(Op::minimum, l.x, l.n(1.0));
  CHECK(at(least, 0.5) == 1.0);
  CHECK(at(least, 1.0) == 1.0);  // equal: the first
  CHECK(at(least, 1.5) == 0.0);
  const Node most = l.g.binary(Op::maximum, l.n(1.0), l.x);
  CHECK(at(most, 1.0) == 0.0);
  CHECK(at(most, 1.5) == 1.0);
  const Node positive = l.g.binary(Op::gt, l.x, l.n(0.0));
  const Node relu = l.g.select(positive, l.g.binary(Op::mul, l.n(3.0), l.x), l.n(0.0));
  CHECK(at(relu, 0.0) == 0.0);
  CHECK(at(relu, 1e-300) == 3.0);
  CHECK(at(l.g.binary(Op::hypot, l.x, l.n(0.0)), 0.0) == 0.0);
  CHECK(at(l.g.binary(Op::pow, l.x, l.g.binary(Op::add, l.x, l.n(2.0))), 0.0) == 0.0);
}

TEST_CASE("what is not chosen does not reach the derivative, not even as NaN", "[tape]") {
  Line l;
  const Node root = l.g.unary(Op::sqrt, l.x), zero = l.n(0.0);
  const Node safe = l.g.select(l.g.binary(Op::gt, l.x, zero), root, zero);
  CHECK(slope(l.g, safe, {-1.0}) == 0.0);
  CHECK(slope(l.g, safe, {0.0}) == 0.0);
  CHECK(slope(l.g, safe, {4.0}) == 0.25);
  const Node clipped = l.g.binary(Op::minimum, l.g.unary(Op::neg, l.x), root);
  CHECK(slope(l.g, clipped, {0.0}) == -1.0);
}

TEST_CASE("truths and steps have no entry in a Jacobian", "[tape]") {
  Line l;
  std::vector<Node> flat = {l.g.time(), l.n(2.0), l.g.unary(Op::logical_not, l.x)};
  for (const Op op : {Op::floor, Op::ceil, Op::trunc, Op::rint, Op::sign}) {
    flat.push_back(l.g.unary(op, l.x));
  }
  for (const Op op : {Op::lt, Op::le, Op::eq, Op::ne, Op::logical_and, Op::floor_divide}) {
    flat.push_back(l.g.binary(op, l.x, l.n(3.0)));
  }
  CHECK(jacobian(Tape(l.g, flat)).entries.empty());
}

TEST_CASE("an entry that is zero whatever the state is not there", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1), p = g.parameter(0);
  const Node gone = g.binary(Op::sub, g.binary(Op::add, x, y), x);
  const Node nothing = g.binary(Op::mul, g.constant(0.0), x);
  const Jacobian result = jacobian(tape_of(g, {gone, nothing, g.binary(Op::mul, p, y), x}));
  CHECK(places(result) == Places{{3, 0}, {0, 1}, {2, 1}});
  CHECK(values_of(result.values, {.p = {7.0}}) == std::vector{1.0, 1.0, 7.0});
  CHECK(result.values.reads() == saltus::Reads::parameters);
}

TEST_CASE("a linear model has a constant Jacobian", "[tape]") {
  Graph g;
  const auto x = [&](int i) { return g.continuous_state(i); };
  const auto times = [&](double k, Node node) { return g.binary(Op::mul, g.constant(k), node); };
  const Node first = g.binary(Op::add, times(2.0, x(0)), g.binary(Op::div, x(3), g.constant(3.0)));
  const Node second =
      g.binary(Op::sub, times(5.0, g.binary(Op::sub, x(0), x(3))), times(4.0, x(0)));
  const Jacobian result = jacobian(tape_of(g, {first, second}));
  CHECK(places(result) == Places{{0, 0}, {1, 0}, {0, 3}, {1, 3}});  // no column 1 or 2
  for (const Node value : result.values.outputs()) CHECK(result.values.graph().value(value));
  CHECK(values_of(result.values, {}) == std::vector{2.0, 1.0, 1.0 / 3.0, -5.0});
}

TEST_CASE("a chain has a band, a sum a full row, and both cost what they must", "[tape]") {
  const int n = 50;
  Graph g;
  std::vector<Node> chain;
  Node sum = g.constant(0.0);
  for (int i = 0; i < n; ++i) {
    const Node left = g.continuous_state(std::max(0, i - 1)), here = g.continuous_state(i);
    chain.push_back(g.binary(Op::mul, g.unary(Op::sin, left), here));
    sum = g.binary(Op::add, sum, g.unary(Op::exp, g.unary(Op::sin, here)));
  }
  const Jacobian band = jacobian(Tape(g, chain));
  CHECK(band.entries.size() == 2 * n - 1);
  for (const auto& entry : band.entries)
    CHECK((entry.row - entry.column == 0 || entry.row - entry.column == 1));
  const Jacobian row = jacobian(tape_of(g, {g.unary(Op::log, sum)}));
  CHECK(row.entries.size() == n);
  // sin, exp, cos, two products for each state; the sum, its logarithm's slope: 1 + 1/n of it.
  CHECK(row.values.instruction_count() <= 6 * n + 2);
}

TEST_CASE("a derivative shares what it has in common with others", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0);
  Node node = x;
  for (int i = 0; i < 10; ++i) node = g.unary(Op::sin, node);
  const Jacobian result = jacobian(tape_of(g, {node, g.binary(Op::add, node, g.time())}));
  CHECK(result.entries.size() == 2);
  // ten cosines, nine sines, nine products, a copy for the second entry
  CHECK(result.values.instruction_count() <= 29);
}

TEST_CASE("derivatives with respect to any variables", "[tape]") {
  Graph g;
  const Node p = g.parameter(3), u = g.input(0, 1), t = g.time(), x = g.continuous_state(0);
  const Node value =
      g.binary(Op::mul, g.binary(Op::mul, p, p), g.binary(Op::add, u, g.unary(Op::sin, t)));
  const std::vector<Node> outputs = {x, value}, variables = {t, p, u};
  const auto partials = differentiate(g, outputs, variables);
  REQUIRE(partials.size() == 3);
  std::vector<Node> nodes;
  for (const Partial& partial : partials) {
    CHECK(partial.row == 1);
    CHECK(partial.column == static_cast<saltus::Index>(nodes.size()));
    nodes.push_back(partial.value);
  }
  const World world{.time = 0.5, .p = {0.0, 0.0, 0.0, 3.0}, .u = {{0.0, 2.0}}};
  const auto values = values_of(Tape(g, nodes), world);
  CHECK_THAT(values[0], WithinRel(9.0 * std::cos(0.5), 1e-15));
  CHECK_THAT(values[1], WithinRel(6.0 * (2.0 + std::sin(0.5)), 1e-15));
  CHECK(values[2] == 9.0);
  CHECK_THROWS_AS(differentiate(g, outputs, std::vector{Node{10000}}), saltus::ModelError);
}

TEST_CASE("the Jacobian of a Jacobian is the second derivative", "[tape]") {
  Line l;
  const Tape first = jacobian(tape_of(l.g, {l.g.unary(Op::tanh, l.x)})).values;
  const Tape second = jacobian(first).values;
  const double t = std::tanh(0.3);
  CHECK_THAT(values_of(second, {.x = {0.3}})[0], WithinAbs(-2.0 * t * (1.0 - t * t), 1e-15));
}
