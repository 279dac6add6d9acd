// Each operation of a series: against derivatives of its tape, the order of its error, in lanes.
#include <cmath>
#include <random>

#include "support/catch.hpp"
#include "support/series_operations.hpp"
#include "support/series_world.hpp"

using namespace saltus::tape;
using namespace support;
using Catch::Matchers::WithinAbs, Catch::Matchers::WithinRel;

namespace {

Numbers random_point(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  Numbers x(n);
  for (double& value : x) value = std::uniform_real_distribution<double>(-2.0, 2.0)(random);
  return x;
}

}  // namespace

TEST_CASE("each operation has the derivatives of its tape") {
  // x' = 0.3 + 0.2 y, y' = -0.4 x + 0.1 t: nothing vanishes
  Graph g;
  const Node t = g.time(), x = g.continuous_state(0), y = g.continuous_state(1);
  const auto mul = [&](double a, Node b) { return g.binary(Op::mul, g.constant(a), b); };
  const std::vector<Node> rates{g.binary(Op::add, g.constant(0.3), mul(0.2, y)),
                                g.binary(Op::add, mul(-0.4, x), mul(0.1, t))};
  const auto all = operations(g, x, y, GENERATE(false, true));
  const World world{.time = 0.7, .x = {0.6, 0.8}, .p = {1.25}};
  constexpr int order = 6;
  Series series(g, rates, nodes_of(all));
  expanded(series, world, order);
  const Numbers found = outputs_of(series, order);
  const Numbers expected = by_derivatives(g, rates, nodes_of(all), world, order);
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO(all[i / (order + 1)].name << ", order " << i % (order + 1));
    // the derivatives are up to 6! times the coefficients, and sums of some hundred terms
    CHECK_THAT(found[i], WithinRel(expected[i], 1e-11) || WithinAbs(expected[i], 1e-13));
  }
}

TEST_CASE("the values are the bits of the tape") {
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1);
  const auto all = operations(g, x, y);
  Series series(g, std::array{y, x}, nodes_of(all));
  const Tape tape(g, nodes_of(all));
  for (unsigned seed = 0; seed < 50; ++seed) {
    const World world{.x = random_point(2, seed), .p = {1.25}};
    expanded(series, world, 2);
    const Numbers found = outputs_of(series, 2), expected = values_of(tape, world);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      INFO(all[i].name);
      CHECK(same_bits(found[3 * i], expected[i]));
    }
  }
}

TEST_CASE("halving h divides the error of order p by 2^(p+1), for each operation") {
  Graph g;
  const auto wave = [&](double middle, double speed) {
    const Node s = g.unary(Op::sin, g.binary(Op::mul, g.constant(speed), g.time()));
    return g.binary(Op::add, g.constant(middle), g.binary(Op::mul, g.constant(0.2), s));
  };
  const auto all = operations(g, wave(0.55, 1.0), wave(0.6, 0.9));
  Series series(g, {}, nodes_of(all));
  const Tape tape(g, nodes_of(all));
  constexpr double start = 0.4;
  int measured = 0;
  for (const int order : {1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 15, 16, 20}) {
    expanded(series, {.time = start, .p = {1.25}}, order);
    const Numbers c = outputs_of(series, order);
    const auto errors = [&](double h) {  // on both sides, where the second term has either sign
      Numbers worst(all.size());
      for (const double s : {-h, h}) {
        const Numbers values = values_of(tape, {.time = start + s, .p = {1.25}});
        for (std::size_t m = 0; m < all.size(); ++m) {
          const double error = values[m] - polynomial(&c[m * size(order + 1)], order, s);
          worst[m] = std::max(worst[m], std::fabs(error));
        }
      }
      return worst;
    };
    std::vector<Numbers> by_step;
    for (double h = 0.8; h > 1e-3; h /= 2) by_step.push_back(errors(h));
    for (std::size_t m = 0; m < all.size(); ++m) {
      // the first step that is small enough for the leading term, above rounding at half of it
      const auto usable = [&](std::size_t i) {
        return by_step[i][m] < 1e-3 && by_step[i + 1][m] > 1e-13;
      };
      std::size_t i = 0;
      while (i + 1 < by_step.size() && !usable(i)) ++i;
      if (i + 1 == by_step.size()) continue;  // a step: its error is 0
      // the latest usable one: there the leading term is largest
      while (i + 2 < by_step.size() && usable(i + 1)) ++i;
      ++measured;
      INFO(all[m].name << ", order " << order << ", " << by_step[i][m] << ", "
                       << by_step[i + 1][m]);
      CHECK(std::log2(by_step[i][m] / by_step[i + 1][m]) > order + 0.5);
    }
  }
  CHECK(measured > 500);
}

TEST_CASE("many alike equations have the coefficients that each has alone") {
  constexpr int copies = 7, order = 21;  // no multiple of the lanes
  Graph names;
  const auto kinds = operations(names, names.time(), names.time());
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    INFO(kinds[kind].name);
    const World one{.time = 0.1, .p = {1.25}};
    Graph all;
    std::vector<Node> rates, outputs;
    World world = one;
    Numbers expected, expected_outputs;
    std::vector<char> held;  // one state
    int instructions = 0;
    for (int i = 0; i < copies; ++i) {
      // x' = op(x + t/8, y), y' = c x
      const auto add_to = [&](Graph& g, int copy, std::vector<Node>& to, std::vector<Node>& out) {
        const Node x = g.continuous_state(2 * copy), y = g.continuous_state(2 * copy + 1);
        const Node a = g.binary(Op::add, x, g.binary(Op::mul, g.time(), g.constant(0.125)));
        to.push_back(operations(g, a, y)[kind].node);
        to.push_back(g.binary(Op::mul, g.constant(0.3 + 0.1 * i), x));
        out.push_back(g.unary(Op::exp, to[to.size() - 2]));
      };
      Graph g;
      std::vector<Node> own, out;
      add_to(g, 0, own, out);
      add_to(all, i, rates, outputs);
      World here = one;
      here.x = {0.4 + 0.02 * i, 0.5 - 0.03 * i};
      world.x.insert(world.x.end(), here.x.begin(), here.x.end());
      Series series(g, own, out);
      instructions += series.instruction_count();
      const char here_held[] = {i == 2 ? '\1' : '\0', 0};
      held.insert(held.end(), here_held, here_held + 2);
      for (const double c : expanded(series, here, order, here_held)) expected.push_back(c);
      for (const double c : outputs_of(series, order)) expected_outputs.push_back(c);
    }
    Series together(all, rates, outputs);
    const Numbers found = expanded(together, world, order, held.data());
    const bool in_lanes = kinks(all, rates).empty() && instructions > copies;
    if (in_lanes) CHECK(together.instruction_count() < instructions);
    for (std::size_t k = 0; k <= order; ++k) {
      for (std::size_t i = 0; i < 2 * copies; ++i) {
        const double alone = expected[(i / 2 * (order + 1) + k) * 2 + i % 2];
        INFO("state " << i << ", order " << k);
        // sums of k products in another order; their terms are up to 2^k times the coefficient
        CHECK_THAT(found[2 * copies * k + i], WithinRel(alone, 1e-9) || WithinAbs(alone, 1e-13));
      }
    }
    const Numbers found_outputs = outputs_of(together, order);
    for (std::size_t i = 0; i < found_outputs.size(); ++i) {
      const double alone = expected_outputs[i];
      CHECK_THAT(found_outputs[i], WithinRel(alone, 1e-9) || WithinAbs(alone, 1e-13));
    }
  }
}

TEST_CASE("whole powers of 0 are smooth, with a constant exponent and with a parameter") {
  for (const double p : {1.0, 2.0, 3.0, 5.0, 9.0, 20.0}) {
    const Numbers found = along(
        [](Graph& g, Node x) {
          const Node u =
              g.binary(Op::sub, g.unary(Op::exp, x), g.constant(1.0));  // x + x^2/2 + ...
          return g.binary(Op::pow, u, g.parameter(0));
        },
        0.0, 21, p);
    const int n = static_cast<int>(p);
    for (int k = 0; k < n; ++k) CHECK(found[size(k)] == 0.0);
    CHECK_THAT(found[size(n)], WithinRel(1.0, 1e-14));
    CHECK_THAT(found[size(n + 1)], WithinRel(p / 2, 1e-14));
  }
  const Numbers fifth =
      along([](Graph& g, Node x) { return g.binary(Op::pow, x, g.constant(5.0)); }, 0.0, 6);
  CHECK(fifth == Numbers{0, 0, 0, 0, 0, 1, 0});
  const Numbers square = along(
      [](Graph& g, Node x) { return g.binary(Op::pow, g.binary(Op::mul, x, x), g.parameter(0)); },
      0.0, 6, 1.5);
  CHECK(square[2] == 0.0);
  CHECK_THAT(square[3], WithinRel(1.0, 1e-14));
}

TEST_CASE("the logarithm of a constant 0 does not reach its power") {
  const Numbers found =
      along([](Graph& g, Node x) { return g.binary(Op::pow, g.parameter(0), x); }, 0.5, 3, 0.0);
  CHECK(found == Numbers{0, 0, 0, 0});
}
