// Expressions drawn at random: against derivatives of their tapes, and of high orders against
// Cauchy's integral.
#include <cmath>
#include <numbers>
#include <random>

#include "support/catch.hpp"
#include "support/expressions.hpp"
#include "support/series_world.hpp"

using namespace saltus::tape;
using namespace support;

namespace {

Numbers random_point(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  Numbers x(n);
  for (double& value : x) value = std::uniform_real_distribution<double>(-2.0, 2.0)(random);
  return x;
}

}  // namespace

TEST_CASE("random expressions have the coefficients that repeated differentiation gives") {
  int checked = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RandomExpression e = random_expression(seed);
    if (e.steps.size() > 40) continue;  // derivatives of derivatives grow
    Graph g;
    const std::vector<Node> outputs = write(e, g);
    std::vector<Node> rates;
    for (std::size_t i = 0; i < e.variables; ++i) rates.push_back(outputs[i % outputs.size()]);
    const World world{.x = random_point(e.variables, seed)};
    constexpr int order = 3;
    Series series(g, rates, outputs);
    const Numbers x = expanded(series, world, order), found = outputs_of(series, order);
    const Numbers values = values_of(Tape(g, outputs), world);
    const Numbers expected = by_derivatives(g, rates, outputs, world, order);
    INFO("seed " << seed);
    for (std::size_t i = 0; i < found.size(); ++i) {
      INFO("output " << i / (order + 1) << ", order " << i % (order + 1));
      // as in the test of random Jacobians, and a thousand times as much for three derivatives
      CHECK(std::fabs(found[i] - expected[i]) <= 1e-8 * std::max(1.0, std::fabs(expected[i])));
      if (i % (order + 1) == 0) CHECK(same_bits(found[i], values[i / (order + 1)]));
      ++checked;
    }
  }
  CHECK(checked > 500);
}

TEST_CASE("random analytic expressions have the coefficients of Cauchy's integral") {
  // u_k = (1/N) sum of u(t + r e^(i phi)) e^(-i k phi) / r^k, with variables that are linear in t
  constexpr int order = 20, points = 64;
  int checked = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const RandomExpression e = random_expression(seed);
    Graph g;
    const Numbers start = random_point(e.variables, seed),
                  speed = random_point(e.variables, seed + 1);
    std::vector<Node> variables;
    for (std::size_t i = 0; i < e.variables; ++i) {
      const Node line = g.binary(Op::mul, g.constant(speed[i]), g.time());
      variables.push_back(g.binary(Op::add, g.constant(start[i]), line));
    }
    const std::vector<Node> outputs = write(e, g, variables);
    if (!e.analytic || !kinks(g, outputs).empty()) continue;
    Series series(g, {}, outputs);
    expanded(series, {.time = 0.0}, order);
    const Numbers found = outputs_of(series, order);
    double growth = 1.0;  // the inverse of the radius, as the last coefficients show it
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double k = static_cast<double>(i % (order + 1));
      if (k > 3) growth = std::max(growth, std::pow(std::fabs(found[i]), 1.0 / k));
    }
    const double r = 0.3 / growth;
    std::vector<std::vector<std::complex<double>>> values;
    for (int j = 0; j < points; ++j) {
      const auto h = std::polar(r, 2.0 * std::numbers::pi * j / points);
      std::vector<std::complex<double>> z;
      for (std::size_t i = 0; i < e.variables; ++i) z.push_back(start[i] + speed[i] * h);
      values.push_back(evaluate(e, z));
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      const int k = static_cast<int>(i % (order + 1));
      std::complex<double> sum = 0.0;
      double largest = 1.0;
      for (int j = 0; j < points; ++j) {
        const auto value = values[size(j)][i / (order + 1)];
        sum += value * std::polar(1.0, -2.0 * std::numbers::pi * j * k / points);
        largest = std::max(largest, std::abs(value));
      }
      INFO("seed " << seed << ", output " << i / (order + 1) << ", order " << k);
      // rounding of the values, and of the recurrences in units of growth^k
      CHECK(std::fabs(sum.real() / points - found[i] * std::pow(r, k)) <= 1e-12 * largest);
      ++checked;
    }
  }
  CHECK(checked > 1000);
}
