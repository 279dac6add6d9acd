#include "saltus/tape/series.hpp"

#include <cmath>

#include "saltus/tape/jacobian.hpp"
#include "support/catch.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;
using Catch::Matchers::WithinAbs, Catch::Matchers::WithinRel;

namespace {

using Numbers = std::vector<double>;

std::size_t size(int n) { return static_cast<std::size_t>(n); }

Numbers expanded(Series& series, const World& world, int order, const char* held = nullptr) {
  Numbers x(size((order + 1) * series.states()), -99.0);
  world.show([&](const saltus::At& at) { series.expand(at, order, held, x.data()); });
  return x;
}

/// The coefficients of all outputs, one row of order + 1 each, after `expanded`.
Numbers outputs_of(Series& series, int order) {
  Numbers g(size((order + 1) * series.outputs()), -99.0);
  series.expand_outputs(0, series.outputs(), g.data());
  return g;
}

/// The coefficients of `outputs` along the solution, by repeated differentiation of the graph:
/// u' = du/dt + sum of du/dx_i f_i.
Numbers by_derivatives(Graph& g, const std::vector<Node>& rates, std::vector<Node> outputs,
                       const World& world, int order) {
  std::vector<Node> variables{g.time()}, speeds{g.constant(1.0)};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    variables.push_back(g.continuous_state(static_cast<saltus::Index>(i)));
    speeds.push_back(rates[i]);
  }
  const std::size_t count = outputs.size();
  Numbers all(count * size(order + 1));
  double factorial = 1.0;
  for (int k = 0; k <= order; ++k) {
    const Numbers now = values_of(Tape(g, outputs), world);
    for (std::size_t m = 0; m < count; ++m) all[m * size(order + 1) + size(k)] = now[m] / factorial;
    factorial *= k + 1.0;
    if (k == order) break;
    std::vector<Node> next(count, g.constant(0.0));
    for (const Partial& partial : differentiate(g, outputs, variables)) {
      Node& sum = next[size(static_cast<int>(partial.row))];
      const Node speed = speeds[size(static_cast<int>(partial.column))];
      sum = g.binary(Op::add, sum, g.binary(Op::mul, partial.value, speed));
    }
    outputs = next;
  }
  return all;
}

}  // namespace

TEST_CASE("The exponential has the coefficients 1/k!") {
  Graph g;
  Series series(g, std::array{g.continuous_state(0)}, {});
  const auto x = expanded(series, {.x = {1.0}}, 30);
  double factorial = 1.0;
  for (int k = 0; k <= 30; ++k) {
    CHECK_THAT(x[size(k)] * factorial, WithinRel(1.0, 1e-14));
    factorial *= k + 1.0;
  }
}

TEST_CASE("x' = x^2 has the coefficients x^(k+1)") {
  Graph g;
  const Node x0 = g.continuous_state(0);
  Series series(g, std::array{g.binary(Op::mul, x0, x0)}, {});
  const auto x = expanded(series, {.x = {0.9}}, 30);
  for (int k = 0; k <= 30; ++k) CHECK_THAT(x[size(k)], WithinRel(std::pow(0.9, k + 1.0), 1e-13));
}

TEST_CASE("Each operation has the derivatives of its tape") {
  // x' = 0.3 + 0.2 y, y' = -0.4 x + 0.1 t: nothing vanishes
  Graph g;
  const Node t = g.time(), x = g.continuous_state(0), y = g.continuous_state(1);
  const auto n = [&](double value) { return g.constant(value); };
  const auto add = [&](Node a, Node b) { return g.binary(Op::add, a, b); };
  const auto mul = [&](Node a, Node b) { return g.binary(Op::mul, a, b); };
  const std::vector<Node> rates{add(n(0.3), mul(n(0.2), y)), add(mul(n(-0.4), x), mul(n(0.1), t))};
  const Node above_one = add(n(1.0), x);
  std::vector<Node> outputs;
  std::vector<std::string> names;
  for (int o = static_cast<int>(Op::neg); o < operation_count; ++o) {
    const Op op = static_cast<Op>(o);
    names.emplace_back(name(op));
    if (operand_count(op) == 1) outputs.push_back(g.unary(op, op == Op::acosh ? above_one : x));
    if (operand_count(op) == 2) outputs.push_back(g.binary(op, x, y));
    if (operand_count(op) == 3) outputs.push_back(g.select(g.binary(Op::lt, x, y), x, y));
  }
  for (const double p : {5.0, 6.0, 7.0, -2.0, 1.5, -1.5, 20.0}) {
    names.push_back("pow " + std::to_string(p));
    outputs.push_back(g.binary(Op::pow, x, n(p)));
  }
  names.push_back("constant to a power");
  outputs.push_back(g.binary(Op::pow, n(0.7), x));
  names.push_back("square"), outputs.push_back(mul(x, x));
  names.push_back("1 / x"), outputs.push_back(g.binary(Op::div, n(1.0), x));
  names.push_back("x / 3"), outputs.push_back(g.binary(Op::div, x, n(3.0)));
  names.push_back("t"), outputs.push_back(t);
  const World world{.time = 0.7, .x = {0.6, 0.8}};
  constexpr int order = 6;
  Series series(g, rates, outputs);
  expanded(series, world, order);
  const Numbers found = outputs_of(series, order);
  const Numbers expected = by_derivatives(g, rates, outputs, world, order);
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO(names[i / (order + 1)] << ", order " << i % (order + 1));
    CHECK_THAT(found[i], WithinRel(expected[i], 1e-11) || WithinAbs(expected[i], 1e-13));
  }
}
