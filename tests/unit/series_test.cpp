#include "saltus/tape/series.hpp"

#include <cmath>

#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/series_world.hpp"

using namespace saltus::tape;
using namespace support;
using Catch::Matchers::WithinAbs, Catch::Matchers::WithinRel;

namespace {

constexpr double g = 9.8;  // [m/s^2] of the pendulum

Series pendulum() {
  Graph graph;
  const Node force =
      graph.binary(Op::mul, graph.constant(-g), graph.unary(Op::sin, graph.continuous_state(0)));
  return {graph, std::array{graph.continuous_state(1), force}, {}};
}

/// Two states, and outputs that share a part.
struct Shared {
  Graph graph;
  std::vector<Node> rates, outputs;
  Shared() {
    const Node x = graph.continuous_state(0), y = graph.continuous_state(1), t = graph.time();
    const Node wave = graph.unary(Op::sin, graph.binary(Op::mul, x, y));
    rates = {graph.binary(Op::mul, wave, y), graph.binary(Op::sub, t, x)};
    const Node root = graph.unary(Op::sqrt, graph.binary(Op::add, wave, graph.constant(2.0)));
    outputs = {graph.binary(Op::mul, root, x),
               graph.binary(Op::div, y, root),
               wave,
               graph.unary(Op::tan, graph.binary(Op::mul, x, t)),
               x,
               t,
               graph.constant(3.0)};
  }
  World world{.time = 0.3, .x = {0.7, -0.4}};
};

}  // namespace

TEST_CASE("the exponential has the coefficients 1/k!") {
  Graph graph;
  Series series(graph, std::array{graph.continuous_state(0)}, {});
  const Numbers x = expanded(series, {.x = {1.0}}, Series::highest_order);
  double factorial = 1.0;
  for (int k = 0; k <= Series::highest_order; factorial *= ++k) {
    CHECK_THAT(x[size(k)] * factorial, WithinRel(1.0, 30 * 0x1p-52));  // one rounding an order
  }
}

TEST_CASE("x' = x^2 has the coefficients x^(k+1)") {
  Graph graph;
  const Node x0 = graph.continuous_state(0);
  Series series(graph, std::array{graph.binary(Op::mul, x0, x0)}, {});
  const Numbers x = expanded(series, {.x = {0.9}}, Series::highest_order);
  for (int k = 0; k <= Series::highest_order; ++k) {
    CHECK_THAT(x[size(k)], WithinRel(std::pow(0.9, k + 1.0), 1e-14));
  }
}

TEST_CASE("a harmonic oscillator has the coefficients of sine and cosine") {
  Graph graph;
  const Node x = graph.continuous_state(0), v = graph.continuous_state(1);
  Series series(graph, std::array{v, graph.unary(Op::neg, x)}, {});
  const Numbers found = expanded(series, {.x = {0.0, 1.0}}, 20);
  double factorial = 1.0;
  for (int k = 0; k <= 20; factorial *= ++k) {
    const double sine[] = {0.0, 1.0, 0.0, -1.0};
    CHECK_THAT(found[size(2 * k)] * factorial, WithinAbs(sine[k % 4], 1e-14));
    CHECK_THAT(found[size(2 * k + 1)] * factorial, WithinAbs(sine[(k + 1) % 4], 1e-14));
  }
}

TEST_CASE("forty polynomials return a pendulum to where it started") {
  Series series = pendulum();
  constexpr int order = 20;
  const double period = 2.0074035758801299, h = period / 40;  // from 0.05 at rest
  Numbers x{0.05, 0.0};
  for (int step = 0; step < 40; ++step) {
    const Numbers all = expanded(series, {.x = x}, order);
    for (std::size_t i = 0; i < 2; ++i) {
      Numbers of_state;
      for (std::size_t k = 0; k <= order; ++k) of_state.push_back(all[2 * k + i]);
      x[i] = polynomial(of_state.data(), order, h);
    }
  }
  // a step's own error is far below rounding: (h sqrt(g))^21 / 21! = 1e-37
  CHECK_THAT(x[0], WithinAbs(0.05, 40 * 0x1p-55));
  CHECK_THAT(x[1], WithinAbs(0.0, 40 * 0x1p-53));
}

TEST_CASE("the coefficients of order 1 are the bits of the right-hand side") {
  Shared s;
  Series series(s.graph, s.rates, {});
  const Numbers x = expanded(series, s.world, 3), f = values_of(Tape(s.graph, s.rates), s.world);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(same_bits(x[i], s.world.x[i]));
    CHECK(same_bits(x[2 + i], f[i]));
  }
}

TEST_CASE("an output has the coefficients that a state with this rate has") {
  Shared s;
  std::vector<Node> rates = s.rates;
  rates.insert(rates.end(), s.outputs.begin(), s.outputs.end());
  World world = s.world;
  world.x.resize(rates.size(), 0.0);
  for (const int order : {1, 3, 4, 5, 8, 13, 16, 20, 29}) {
    Series series(s.graph, s.rates, s.outputs), states(s.graph, rates, {});
    const Numbers x = expanded(series, s.world, order), all = expanded(states, world, order + 1);
    const Numbers outputs = outputs_of(series, order);
    for (std::size_t m = 0; m < s.outputs.size(); ++m) {
      for (std::size_t k = 0; k <= size(order); ++k) {
        INFO("output " << m << ", order " << k << " of " << order);
        const double of_state = all[(k + 1) * rates.size() + 2 + m];
        const double inverse = 1.0 / (static_cast<double>(k) + 1.0);
        CHECK(same_bits(outputs[m * size(order + 1) + k] * inverse, of_state));
      }
    }
  }
}

TEST_CASE("outputs may be asked for one by one, in any order, twice, or not at all") {
  Shared s;
  Series together(s.graph, s.rates, s.outputs), apart(together);
  for (const int order : {20, 4, 9}) {  // memory of a longer expansion must not matter
    expanded(together, s.world, order);
    const Numbers all = outputs_of(together, order);
    expanded(apart, {.time = 1.0, .x = {2.0, 1.0}}, 12);
    expanded(apart, s.world, order);
    for (const int m : {3, 1, 6, 1, 0, 2, 5, 4}) {
      Numbers one(size(order + 1));
      apart.expand_outputs(m, 1, one.data());
      for (std::size_t k = 0; k < one.size(); ++k) {
        CHECK(same_bits(one[k], all[size(m) * one.size() + k]));
      }
    }
  }
}

TEST_CASE("an expression may be an output twice") {
  Graph graph;
  const Node x = graph.continuous_state(0), e = graph.unary(Op::exp, x);
  Series series(graph, std::array{graph.constant(1.0)}, std::array{e, x, e});
  expanded(series, {.x = {0.0}}, 2);
  Numbers second(3);
  series.expand_outputs(2, 1, second.data());
  CHECK(second == Numbers{1.0, 1.0, 0.5});
}

TEST_CASE("an expansion does not depend on earlier ones, not even on NaN") {
  Shared s;
  Series used(s.graph, s.rates, s.outputs), fresh(used);
  for (const int order : {5, 20}) {
    expanded(used, {.time = NAN, .x = {NAN, INFINITY}}, 30);
    outputs_of(used, 30);
    const Numbers a = expanded(used, s.world, order), b = expanded(fresh, s.world, order);
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(same_bits(a[i], b[i]));
    const Numbers of_used = outputs_of(used, order), of_fresh = outputs_of(fresh, order);
    for (std::size_t i = 0; i < of_used.size(); ++i) CHECK(same_bits(of_used[i], of_fresh[i]));
  }
}

TEST_CASE("a held state has the rate 0, even if its expression gives NaN") {
  Graph graph;
  const Node x = graph.continuous_state(0), y = graph.continuous_state(1);
  Series series(graph, std::array{graph.unary(Op::log, graph.unary(Op::neg, x)), x},
                std::array{graph.binary(Op::mul, x, y)});
  const char held[] = {1, 0};
  const Numbers all = expanded(series, {.x = {2.0, 1.0}}, 5, held);
  CHECK(all == Numbers{2, 1, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0});
  CHECK(outputs_of(series, 5) == Numbers{2, 4, 0, 0, 0, 0});
}

TEST_CASE("inputs, parameters, discrete states, mode and entry are constant in time") {
  Graph graph;
  const Node x = graph.continuous_state(0);
  const std::array<Node, 5> constants{graph.input(1, 1), graph.parameter(1),
                                      graph.discrete_state(1), graph.mode(), graph.entry()};
  Node rate = x;  // x' = x * u * p * z * mode * entry
  for (const Node constant : constants) rate = graph.binary(Op::mul, rate, constant);
  Series series(graph, std::array{rate}, constants);
  const World world{
      .x = {1.0}, .z = {0, 0.5}, .p = {0, 3.0}, .u = {{0}, {0, 0.25}}, .mode = 2, .entry = 4};
  const Numbers found = expanded(series, world, 12);  // x' = 3 x
  double power = 1.0;
  for (int k = 0; k <= 12; power *= 3.0 / ++k) CHECK_THAT(found[size(k)], WithinRel(power, 1e-14));
  expanded(series, world, 1);
  CHECK(outputs_of(series, 1) == Numbers{0.25, 0, 3, 0, 0.5, 0, 2, 0, 4, 0});
}

TEST_CASE("a system without states has functions of time") {
  Graph graph;
  Series series(graph, {}, std::array{graph.unary(Op::exp, graph.time())});
  expanded(series, {.time = 0.0}, 6);
  const Numbers found = outputs_of(series, 6);
  CHECK_THAT(found[6], WithinRel(1.0 / 720.0, 1e-15));
}

TEST_CASE("nothing is allocated by an expansion, of states or of outputs") {
  Shared s;
  Series series(s.graph, s.rates, s.outputs);
  Numbers x(2 * 31), out(7 * 31);
  const long found = s.world.show([&](const saltus::At& at) {
    return allocations_of([&] {
      for (const int order : {3, 30}) {
        series.expand(at, order, nullptr, x.data());
        series.expand_outputs(0, 7, out.data());
      }
    });
  });
  CHECK(found <= 0);
}

TEST_CASE("a copy has its own memory") {
  Shared s;
  Series series(s.graph, s.rates, s.outputs);
  expanded(series, s.world, 9);
  Series other = series;
  const Numbers expected = outputs_of(series, 9);
  expanded(series, {.time = 5.0, .x = {1.0, 2.0}}, 9);
  CHECK(outputs_of(other, 9) == expected);
}

TEST_CASE("a series refuses orders it has no room for, and states without a rate") {
  Graph graph;
  const Node x = graph.continuous_state(0);
  Series series(graph, std::array{x}, {});
  CHECK_THROWS_WITH(expanded(series, {.x = {1.0}}, 31),
                    "a series expects an order from 0 to 30, found 31");
  CHECK_THROWS_WITH(expanded(series, {.x = {1.0}}, -1),
                    "a series expects an order from 0 to 30, found -1");
  CHECK_THROWS_WITH(series.expand_outputs(0, 1, nullptr),
                    "a series of 0 outputs was asked for 1 of them from number 0 on");
  CHECK(expanded(series, {.x = {1.5}}, 0) == Numbers{1.5});
  CHECK_THROWS_WITH(
      Series(graph, std::array{x}, std::array{graph.continuous_state(3)}),
      "a series of 1 rates expects expressions that read states below 1, found state 3");
}
