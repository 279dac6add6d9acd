// The expansion of a series as machine code: the bits of the interpreted one. The text runs without
// a compiler, see support/llvm_runner.hpp.
#include <random>

#include "support/catch.hpp"
#include "support/expressions.hpp"
#include "support/llvm_runner.hpp"
#include "support/series_operations.hpp"
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

/// The same series twice: one is interpreted, the other is compiled.
struct Pair {
  Pair(const Graph& g, const std::vector<Node>& rates, const std::vector<Node>& outputs, int order)
      : interpreted(g, rates, outputs), compiled(g, rates, outputs) {
    compile({}, std::array{compiled.at_order(order)}, &run_as_text);
  }
  Series interpreted, compiled;
};

void check_same(const Numbers& found, const Numbers& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO("number " << i << ": " << found[i] << ", " << expected[i]);
    CHECK(same_bits(found[i], expected[i]));
  }
}
void check_bits(Pair& pair, const World& world, int order, const char* held = nullptr) {
  check_same(expanded(pair.compiled, world, order, held),
             expanded(pair.interpreted, world, order, held));
  check_same(outputs_of(pair.compiled, order), outputs_of(pair.interpreted, order));
}

}  // namespace

TEST_CASE("each operation has the bits of the interpreted series, at each order", "[series]") {
  const bool as_rates = GENERATE(false, true);
  int written = 0;
  for (std::size_t number = 0;; ++number) {
    Graph g;
    const Node x = g.continuous_state(0), y = g.continuous_state(1);
    const auto all = operations(g, x, y);
    if (number == all.size()) break;
    std::vector<Node> rates{y, g.unary(Op::neg, x)};
    if (as_rates) rates[1] = all[number].node;
    for (const int order : {1, 2, 3, 4, 5, 8, 11, 12, 20, 30}) {
      INFO(all[number].name << ", order " << order);
      Pair pair(g, rates, {all[number].node}, order);
      written += pair.compiled.at_order(order).is_machine_code() ? 1 : 0;
      check_bits(pair, {.time = 0.3, .x = {0.6, 0.8}, .p = {1.25}}, order);
    }
  }
  CHECK(written > 800);
}

TEST_CASE("four alike expressions at once have the bits of the interpreted series", "[series]") {
  for (std::size_t number = 0;; ++number) {
    Graph g;
    const Node x = g.continuous_state(0), y = g.continuous_state(1);
    const std::size_t count = operations(g, x, y).size();
    if (number == count) break;
    std::vector<Node> rates;
    std::string name;
    for (saltus::Index i = 0; i < 6; ++i) {
      const auto all = operations(g, g.continuous_state(i), g.continuous_state((i + 1) % 6));
      rates.push_back(all[number].node);
      name = all[number].name;
    }
    for (const int order : {3, 8, 13}) {
      INFO(name << ", order " << order);
      Pair pair(g, rates, {rates[0]}, order);
      check_bits(pair, {.x = {0.6, 0.8, 0.55, 0.7, 0.65, 0.75}, .p = {1.25}}, order);
    }
  }
}

TEST_CASE("long series share recurrences, and have the bits of the interpreted one", "[series]") {
  Graph g;
  std::vector<Node> rates;
  for (saltus::Index i = 0; i < 12; ++i) {
    const Node x = g.continuous_state(i), y = g.continuous_state((i + 1) % 12);
    Node sum = g.time();
    for (const Node one :
         {g.unary(Op::sin, x), g.unary(Op::exp, x), g.unary(Op::log, y), g.unary(Op::tanh, x),
          g.binary(Op::div, x, y), g.unary(Op::sqrt, y), g.binary(Op::atan2, x, y),
          g.binary(Op::pow, x, g.constant(0.3)), g.binary(Op::mul, x, x)}) {
      sum = g.binary(Op::add, sum, g.binary(Op::mul, one, g.constant(0.1)));
    }
    rates.push_back(sum);
  }
  constexpr int order = 13;
  Numbers start;
  for (int i = 0; i < 12; ++i) start.push_back(0.5 + 0.02 * i);
  const std::vector<Node> outputs{g.binary(Op::mul, rates[0], rates[1])};
  Pair pair(g, rates, outputs, order);
  REQUIRE(pair.compiled.at_order(order).is_machine_code());
  const auto text = llvm_module(std::array{Series(g, rates, outputs).at_order(order)}).first;
  CHECK(text.find("call void") != std::string::npos);
  check_bits(pair, {.time = 0.3, .x = start, .p = {1.25}}, order);
}

TEST_CASE("random expressions have the bits of the interpreted series", "[series]") {
  int compiled = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RandomExpression e = random_expression(seed);
    if (e.steps.size() > 40) continue;
    Graph g;
    const std::vector<Node> outputs = write(e, g);
    std::vector<Node> rates;
    for (std::size_t i = 0; i < e.variables; ++i) rates.push_back(outputs[i % outputs.size()]);
    INFO("seed " << seed);
    Pair pair(g, rates, outputs, 9);
    compiled += pair.compiled.at_order(9).is_machine_code() ? 1 : 0;
    check_bits(pair, {.x = random_point(e.variables, seed)}, 9);
  }
  CHECK(compiled > 10);
}

TEST_CASE("held states, other orders and powers of 0 are interpreted", "[series]") {
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1);
  const std::vector<Node> rates{y, g.binary(Op::pow, x, g.constant(2.3))};
  Pair pair(g, rates, {g.binary(Op::mul, x, y)}, 7);
  CHECK(pair.compiled.at_order(7).is_machine_code());
  CHECK_FALSE(pair.compiled.at_order(8).is_machine_code());
  const char held[] = {0, 1};
  for (const double start : {0.5, 0.0}) {
    const World world{.x = {start, 1.0}};
    check_bits(pair, world, 7);
    check_bits(pair, world, 7, held);
    check_bits(pair, world, 8);
    check_bits(pair, world, 7);
  }
}

TEST_CASE("a copy of a series runs the same code", "[series]") {
  Graph g;
  const Node x = g.continuous_state(0);
  const Series first(g, std::array{g.unary(Op::sin, x)}, {});
  const Series copy = first;
  compile({}, std::array{first.at_order(5)}, &run_as_text);
  CHECK(copy.at_order(5).is_machine_code());
}
