// Symbols and packs compute what numbers do, to the last bit; a tape puts values where it is told.
#include <tuple>

#include "saltus/base/pack.hpp"
#include "saltus/tape/symbol.hpp"
#include "support/catch.hpp"
#include "support/tape_world.hpp"

using namespace saltus;
using namespace support;

namespace {

/// All operations once.
template <class Number>
std::vector<Number> all(const Number& a, const Number& b) {
  using std::abs, std::sqrt, std::cbrt, std::exp, std::expm1, std::log, std::log10, std::log1p;
  using std::sin, std::cos, std::tan, std::asin, std::acos, std::atan, std::sinh, std::cosh;
  using std::tanh, std::atan2, std::hypot;
  Number sum = a, difference = a, product = a, ratio = a;
  sum += b, difference -= b, product *= b, ratio /= b;
  return {a + b,         a - b,          a * b,         a / b,          -a,
          sum,           difference,     product,       ratio,          abs(a),
          sqrt(a),       cbrt(a),        exp(a),        expm1(a),       log(a),
          log10(a),      log1p(a),       sin(a),        cos(a),         tan(a),
          asin(a),       acos(a),        atan(a),       sinh(a),        cosh(a),
          tanh(a),       atan2(a, b),    hypot(a, b),   2.0 - a,        a * 3.0,
          Number(a < b), Number(a <= b), Number(a > b), Number(a >= b), Number(a == b),
          Number(a != b)};
}

constexpr std::array pairs{std::pair{0.3, -1.7}, std::pair{-0.7, 0.2}, std::pair{0.5, 0.5},
                           std::pair{-0.0, 0.0}, std::pair{4.0, 1e-300}};

bool same(double a, double b) {
  return (a == b && std::signbit(a) == std::signbit(b)) || (std::isnan(a) && std::isnan(b));
}

}  // namespace

TEST_CASE("a symbol leaves the operations that numbers go through", "[tape]") {
  for (const auto& [a, b] : pairs) {
    tape::Graph graph;
    const tape::Symbol x(graph, graph.continuous_state(0)), y(graph, graph.continuous_state(1));
    std::vector<tape::Node> nodes;
    for (const tape::Symbol& symbol : all(x, y)) nodes.push_back(symbol.in(graph));
    const auto computed = values_of(tape::Tape(graph, nodes), {.x = {a, b}});
    const auto expected = all(a, b);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      INFO("operation " << i << " of " << a << ", " << b);
      CHECK(same(computed[i], expected[i]));
    }
  }
}

TEST_CASE("symbols of numbers alone are numbers", "[tape]") {
  tape::Graph graph;
  const tape::Symbol two = 2.0;
  CHECK(graph.value((two * 3.0 + sin(two)).in(graph)) == 2.0 * 3.0 + std::sin(2.0));
}

TEST_CASE("a pack is as many numbers", "[library]") {
  std::array<double, Pack::size> a{}, b{}, found{};
  for (std::size_t i = 0; i < a.size(); ++i) std::tie(a[i], b[i]) = pairs[i % pairs.size()];
  const auto computed = all(Pack(a.data()), Pack(b.data()));
  for (std::size_t k = 0; k < computed.size(); ++k) {
    computed[k].store(found.data());
    for (std::size_t i = 0; i < a.size(); ++i) {
      INFO("operation " << k << " of " << a[i] << ", " << b[i]);
      CHECK(same(found[i], all(a[i], b[i])[k]));
    }
  }
  Pack::choose(Pack(a.data()) < 0.0, Pack(a.data()), Pack(b.data())).store(found.data());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(same(found[i], a[i] < 0.0 ? a[i] : b[i]));
}

TEST_CASE("a tape puts each value to its place and touches no other", "[tape]") {
  const Index n = GENERATE(2, 40);  // 40: runs of equal operations
  tape::Graph graph;
  std::vector<tape::Node> nodes;
  std::vector<Index> places;
  std::vector<double> x, expected(static_cast<std::size_t>(3 * n), -1.0);
  for (Index i = 0; i < n; ++i) {
    const tape::Node node = graph.continuous_state(i);
    x.push_back(static_cast<double>(i));
    nodes.push_back(graph.binary(tape::Op::mul, node, node));
    nodes.push_back(node);
    places.push_back(3 * (n - 1 - i)), places.push_back(3 * (n - 1 - i) + 2);
    expected[static_cast<std::size_t>(places[places.size() - 2])] = x.back() * x.back();
    expected[static_cast<std::size_t>(places.back())] = x.back();
  }
  const tape::Tape tape(graph, nodes, places);
  std::vector<double> out(expected.size(), -1.0);
  World{.x = x}.show([&](const At& at) { tape.evaluate(at, out.data()); });
  CHECK(out == expected);
  places.pop_back();
  CHECK_THROWS_AS(tape::Tape(graph, nodes, places), ModelError);
}
