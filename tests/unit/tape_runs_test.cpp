// Rows of like equations become runs, one instruction for all; each value is what it is alone.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "saltus/tape/jacobian.hpp"
#include "support/catch.hpp"
#include "support/expressions.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;
using Catch::Matchers::Contains;

namespace {

/// Heat along a rod: x'[i] = p[0] * (x[i - 1] - 2 x[i] + x[i + 1]), ends isolated.
Tape rod(int n) {
  Graph g;
  const auto op = [&](Op o, Node a, Node b) { return g.binary(o, a, b); };
  const auto x = [&](int i) { return g.continuous_state(std::clamp(i, 0, n - 1)); };
  std::vector<Node> outputs;
  for (int i = 0; i < n; ++i) {
    const Node twice = op(Op::mul, g.constant(2.0), x(i));
    const Node bend = op(Op::add, op(Op::sub, x(i - 1), twice), x(i + 1));
    outputs.push_back(op(Op::mul, g.parameter(0), bend));
  }
  return {g, outputs};
}

std::vector<double> ramp(std::size_t n, double phase = 1.0) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(phase + 0.7 * static_cast<double>(i));
  return x;
}

/// Random expressions of the same form, for rows of states, parameters and inputs.
struct Rows {
  explicit Rows(unsigned seed) : random(seed), e(random_expression(seed)), n(2 + below(12)) {
    e.analytic = true;
    world.time = 0.4;
    world.x = ramp(40), world.p = ramp(40, 2.0);
    world.u = {{}, ramp(40, 3.0)};
    for (std::size_t k = 0; k < e.variables; ++k) {
      rows.push_back({below(4), static_cast<int>(below(4)) - 1, 15 + below(4)});
    }
  }
  std::size_t below(std::size_t k) { return random() % k; }

  struct Row {
    std::size_t array;  ///< 0: x, 1: p, 2: u[1], 3: the time
    int stride;
    std::size_t first;
  };
  std::size_t place(const Row& row, std::size_t i) const {
    return row.first + i * static_cast<std::size_t>(row.stride);  // wraps around for -1
  }
  Node node(Graph& g, const Row& row, std::size_t i) const {
    const auto entry = static_cast<saltus::Index>(place(row, i) % 40);
    if (row.array == 0) return g.continuous_state(entry);
    if (row.array == 1) return g.parameter(entry);
    return row.array == 2 ? g.input(1, entry) : g.time();
  }
  double number(const Row& row, std::size_t i) const {
    if (row.array == 3) return world.time;
    const auto& array = row.array == 0 ? world.x : row.array == 1 ? world.p : world.u[1];
    return array[place(row, i) % 40];
  }

  std::mt19937 random;
  RandomExpression e;
  std::size_t n;
  World world;
  std::vector<Row> rows;
};

}  // namespace

TEST_CASE("a rod costs as many instructions however long it is", "[tape]") {
  CHECK(rod(1000).instruction_count() == rod(20).instruction_count());
  CHECK(rod(20).instruction_count() <= 10);
  for (const std::size_t n : {2U, 3U, 5U, 6U, 7U, 20U, 1000U}) {
    const auto x = ramp(n);
    const double k = 0.3;
    const auto found = values_of(rod(static_cast<int>(n)), {.x = x, .p = {k}});
    for (std::size_t i = 0; i < n; ++i) {
      const double left = x[i == 0 ? 0 : i - 1], right = x[std::min(i + 1, n - 1)];
      INFO("cell " << i << " of " << n);
      CHECK(same_bits(found[i], k * ((left - 2.0 * x[i]) + right)));
    }
  }
}

TEST_CASE("a run is one line to read", "[tape]") {
  CHECK_THAT(rod(20).to_string(), Contains("= mul(2, x[0:20])") && Contains("x[1:20]"));
}

TEST_CASE("states that take turns are runs too", "[tape]") {
  Graph g;  // q[i]' = v[i], v[i]' = -sin q[i], stored q0 v0 q1 v1 ...
  std::vector<Node> outputs;
  for (int i = 0; i < 16; ++i) {
    outputs.push_back(g.continuous_state(2 * i + 1));
    outputs.push_back(g.unary(Op::neg, g.unary(Op::sin, g.continuous_state(2 * i))));
  }
  const Tape tape(g, outputs);
  const auto x = ramp(32);
  const auto found = values_of(tape, {.x = x});
  for (std::size_t i = 0; i < 32; i += 2) {
    CHECK(found[i] == x[i + 1]);
    CHECK(same_bits(found[i + 1], -std::sin(x[i])));
  }
  CHECK(tape.instruction_count() <= 2 + 16);
}

TEST_CASE("a state that is loaded for one operation is still part of a run", "[tape]") {
  Graph g;
  const auto x = [&](int i) { return g.continuous_state(i); };
  std::vector<Node> outputs = {g.binary(Op::atan2, x(3), x(1))};
  for (int i = 0; i < 8; ++i) outputs.push_back(g.binary(Op::mul, outputs[0], x(i)));
  for (int i = 0; i < 8; ++i) outputs.push_back(g.binary(Op::mul, g.time(), x(i)));
  const auto values = ramp(8);
  const auto found = values_of(Tape(g, outputs), {.time = 3.0, .x = values});
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(same_bits(found[1 + i], std::atan2(values[3], values[1]) * values[i]));
    CHECK(same_bits(found[9 + i], 3.0 * values[i]));
  }
}

TEST_CASE("random rows have the values of each alone, in any order of outputs", "[tape]") {
  int with_runs = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Rows rows(seed);
    Graph g;
    std::vector<Node> nodes;
    std::vector<double> expected;
    for (std::size_t i = 0; i < rows.n; ++i) {
      std::vector<Node> variables;
      std::vector<double> numbers;
      for (const auto& row : rows.rows) {
        variables.push_back(rows.node(g, row, i));
        numbers.push_back(rows.number(row, i));
      }
      for (const Node node : write(rows.e, g, variables)) nodes.push_back(node);
      for (const double value : evaluate(rows.e, numbers)) expected.push_back(value);
    }
    std::vector<std::size_t> order(nodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (seed % 3 == 0) std::ranges::shuffle(order, rows.random);
    if (seed % 3 == 1) {  // all first outputs, then all second ones
      const std::size_t m = nodes.size() / rows.n;
      std::ranges::sort(order, {}, [m](std::size_t k) { return std::pair(k % m, k / m); });
    }
    std::vector<Node> outputs;
    for (const std::size_t k : order) outputs.push_back(nodes[k]);
    const Tape tape(g, outputs);
    const auto found = values_of(tape, rows.world);
    with_runs += tape.to_string().find(':') != std::string::npos ? 1 : 0;
    INFO("seed " << seed << "\n" << tape.to_string());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(same_bits(found[k], expected[order[k]]));
  }
  CHECK(with_runs > 150);
}

TEST_CASE("the Jacobian of a rod is a band of runs", "[tape]") {
  const Jacobian band = jacobian(rod(100));
  CHECK(band.entries.size() == 298);
  CHECK(band.values.instruction_count() <= 300);
  const auto values = values_of(band.values, {.p = {0.5}});
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto [row, column] = band.entries[k];
    const bool end = row == column && (row == 0 || row == 99);
    CHECK(values[k] == (row != column ? 0.5 : end ? -0.5 : -1.0));
  }
}

namespace {

/// Attraction of n bodies on a line, as arrays compute it: sum over j of (x[j] - x[i]) / (1 + d^2).
Tape attraction(int n) {
  Graph g;
  const auto size = static_cast<std::size_t>(n);
  std::vector<std::vector<Node>> forces(size, std::vector<Node>(size));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Node d = g.binary(Op::sub, g.continuous_state(j), g.continuous_state(i));
      const Node square = g.binary(Op::add, g.binary(Op::mul, d, d), g.parameter(0));
      forces[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          g.binary(Op::div, d, square);
    }
  }
  std::vector<Node> outputs;
  for (const auto& row : forces) {
    Node sum = row[0];
    for (std::size_t j = 1; j < size; ++j) sum = g.binary(Op::add, sum, row[j]);
    outputs.push_back(sum);
  }
  return {g, outputs};
}

}  // namespace

TEST_CASE("what one operation computes is adjacent, so that pairs of bodies are one run",
          "[tape]") {
  // n differences, then one run each for squares, sums and quotients, then n - 1 additions
  for (const int n : {5, 7, 20}) CHECK(attraction(n).instruction_count() <= 2 * n + 6);
  const auto x = ramp(7);
  const auto found = values_of(attraction(7), {.x = x, .p = {0.3}});
  for (std::size_t i = 0; i < 7; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < 7; ++j) {
      const double d = x[j] - x[i];
      sum = j == 0 ? d / (d * d + 0.3) : sum + d / (d * d + 0.3);
    }
    INFO("body " << i);
    CHECK(same_bits(found[i], sum));
  }
}
