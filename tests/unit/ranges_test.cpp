// Ranges: the bounds of expressions hold their values, and are exact for a single sine.
#include "saltus/tape/ranges.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "support/catch.hpp"
#include "support/expressions.hpp"
#include "support/tape_world.hpp"

using namespace saltus;
using namespace support;

namespace ranges_test {

using tape::Graph, tape::Op, tape::Ranges, tape::ValueRange;

/// The bounds of one expression between two times, with other states at the second.
ValueRange range_of(const Graph& graph, tape::Node node, const World& from, double to,
                    const std::vector<double>& x_to = {}) {
  const std::array<tape::Node, 1> outputs{node};
  const Ranges ranges(graph, outputs);
  List<ValueRange> bounds;
  from.show([&](const At& at) { ranges.evaluate(at, to, x_to.data(), bounds); });
  return bounds[ranges.place(0)];
}

}  // namespace ranges_test

using namespace ranges_test;

TEST_CASE("the bounds of random expressions hold all values on the way", "[tape]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> near(0.8, 1.2);
  for (unsigned seed = 0; seed < 400; ++seed) {
    INFO("seed " << seed);
    const RandomExpression e = random_expression(seed);
    Graph graph;
    const tape::Node node = write(e, graph).front();
    World from;
    std::vector<double> to;
    for (std::size_t i = 0; i < e.variables; ++i)
      from.x.push_back(near(random)), to.push_back(near(random));
    const ValueRange range = range_of(graph, node, from, 1.0, to);
    bool holds = true;
    for (int i = 0; i <= 40; ++i) {
      World between = from;
      for (std::size_t k = 0; k < to.size(); ++k) between.x[k] += (to[k] - from.x[k]) * i / 40.0;
      const double value = values_of(tape_of(graph, {node}), between)[0];
      // Roundings, which the operations of an expression enlarge.
      const double room = 1e-9 * (1.0 + std::abs(value));
      holds = holds && !(value < range.low - room) && !(value > range.high + room);
    }
    CHECK(holds);
  }
}

TEST_CASE("the bounds of a sine are those of its part of a period", "[tape]") {
  using std::numbers::pi;
  Graph graph;
  const tape::Node sine = graph.unary(Op::sin, graph.time()),
                   cosine = graph.unary(Op::cos, graph.time());
  const auto of = [&](tape::Node node, double from, double to) {
    return range_of(graph, node, {.time = from}, to);
  };
  for (const double turns : {0.0, 2.0 * pi, -14.0 * pi}) {
    const ValueRange rise = of(sine, turns + 0.1, turns + 0.2);
    CHECK(std::abs(rise.low - std::sin(0.1)) < 1e-13);
    CHECK(std::abs(rise.high - std::sin(0.2)) < 1e-13);
    CHECK(of(sine, turns + 1.5, turns + 1.6).high == 1.0);
    CHECK(of(sine, turns - 1.6, turns - 1.5).low == -1.0);
    CHECK(of(cosine, turns - 0.1, turns + 0.1).high == 1.0);
    CHECK(of(cosine, turns + 3.0, turns + 3.2).low == -1.0);
    CHECK(of(sine, turns, turns + 7.0).low == -1.0);
  }
}

TEST_CASE("an amplitude of zero leaves no bounds but zero", "[tape]") {
  Graph graph;
  const tape::Node wave =
      graph.unary(Op::sin, graph.binary(Op::mul, graph.constant(1e3), graph.time()));
  const tape::Node amplitude =
      graph.binary(Op::maximum, graph.unary(Op::cos, graph.time()), graph.constant(0.0));
  const tape::Node guard =
      graph.binary(Op::sub, graph.binary(Op::mul, amplitude, wave), graph.constant(0.1));
  const ValueRange at_rest = range_of(graph, guard, {.time = 2.0}, 4.0);
  CHECK(at_rest.low == -0.1);
  CHECK(at_rest.high == -0.1);
  CHECK(!at_rest.has_zero());
  CHECK(range_of(graph, guard, {.time = 4.0}, 5.0).has_zero());
}
