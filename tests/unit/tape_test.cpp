// A tape holds what its outputs need and nothing else, and reads its variables where they are.
#include "saltus/tape/tape.hpp"

#include <thread>

#include "saltus/tape/jacobian.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/leaves.hpp"
#include "support/tape_world.hpp"

using saltus::At, saltus::Reads, saltus::VectorFunction, saltus::VectorRef;
using namespace saltus::tape;
using namespace support;
using Catch::Matchers::Contains;

namespace {

/// x[0] + x[1] + ... + x[n - 1], each of them times itself; all products are needed at the end.
std::vector<Node> many_at_once(Graph& g, int n) {
  std::vector<Node> sines;
  for (int i = 0; i < n; ++i) sines.push_back(g.unary(Op::sin, g.continuous_state(i)));
  Node forwards = g.constant(1.0), backwards = g.constant(2.0);
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    forwards = g.binary(Op::sub, sines[k], forwards);
    backwards = g.binary(Op::sub, sines[sines.size() - 1 - k], backwards);
  }
  return {forwards, backwards};
}

}  // namespace

TEST_CASE("every kind of variable is read where it stands", "[tape]") {
  Graph g;
  const Tape tape = tape_of(g, {g.time(), g.continuous_state(1), g.discrete_state(2), g.mode(),
                                g.entry(), g.parameter(1), g.input(2, 1), g.constant(0.25)});
  const World world{.time = 1.5,
                    .x = {0.0, 2.5},
                    .z = {0.0, 0.0, 3.5},
                    .p = {0.0, 4.5},
                    .u = {{}, {0.0}, {0.0, 5.5}},
                    .mode = -7,
                    .entry = 3};
  CHECK(values_of(tape, world) == std::vector{1.5, 2.5, 3.5, -7.0, 3.0, 4.5, 5.5, 0.25});
}

TEST_CASE("only what the outputs need is computed, common expressions once", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0), y = g.continuous_state(1);
  const Node shared = g.unary(Op::sin, g.binary(Op::mul, x, y));
  g.unary(Op::exp, shared);  // nobody wants it
  const Node sum = g.binary(Op::add, shared, x), difference = g.binary(Op::sub, shared, x);
  const Tape tape = tape_of(g, {sum, difference});
  CHECK(tape.to_string().find("exp") == std::string::npos);
  CHECK(tape.instruction_count() <= 4);  // mul, sin, add, sub
  CHECK(tape.graph().size() == 6);
  const double s = std::sin(2.0 * 3.0);
  CHECK(values_of(tape, {.x = {2.0, 3.0}}) == std::vector{s + 2.0, s - 2.0});
}

TEST_CASE("an output may be a variable, a constant, another output, or there twice", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0);
  const Node square = g.binary(Op::mul, x, x), fourth = g.binary(Op::mul, square, square);
  const Tape tape = tape_of(g, {square, x, fourth, square, g.constant(7.0), x});
  CHECK(values_of(tape, {.x = {3.0}}) == std::vector{9.0, 3.0, 81.0, 9.0, 7.0, 3.0});
  CHECK(values_of(tape_of(g, {}), {}).empty());
}

TEST_CASE("a tape knows what it reads", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0), p = g.parameter(0);
  const Tape one = tape_of(g, {g.binary(Op::mul, x, p)});
  CHECK(one.reads() == Reads::continuous_state);
  CHECK(one.reads_parameter());
  CHECK(!one.reads_entry());
  const Tape two = tape_of(g, {g.binary(Op::add, g.time(), g.input(2, 0)), g.entry()});
  CHECK(two.reads() == (Reads::time | Reads::inputs));
  CHECK(two.reads_input(2));
  CHECK(!two.reads_input(0));
  CHECK(two.reads_entry());
  CHECK(tape_of(g, {g.constant(1.0)}).reads() == Reads::parameters);
  CHECK(tape_of(g, {g.mode(), g.discrete_state(0)}).reads() ==
        (Reads::mode | Reads::discrete_state));
}

TEST_CASE("a tape that reads more than there is says so", "[tape]") {
  Graph g;
  const auto check = [&](Node node) {
    World{.x = {1.0}, .u = {{1.0}}}.show([&](const At& at) { tape_of(g, {node}).check(at); });
  };
  CHECK_NOTHROW(check(g.continuous_state(0)));
  CHECK_THROWS_WITH(check(g.continuous_state(2)),
                    Contains("reads entry 2 of the continuous state expects at least 3"));
  CHECK_THROWS_WITH(check(g.discrete_state(0)), Contains("discrete state"));
  CHECK_THROWS_WITH(check(g.parameter(0)), Contains("parameters"));
  CHECK_THROWS_WITH(check(g.input(0, 1)), Contains("input 0"));
  CHECK_THROWS_WITH(check(g.input(1, 0)), Contains("reads input 1 expects at least 2 inputs"));
}

TEST_CASE("a function of a leaf, which keeps the tape alive", "[tape]") {
  VectorFunction function;
  {
    Graph g;
    const Node x = g.continuous_state(0);
    function = as_vector_function(tape_of(g, {g.binary(Op::mul, x, x), g.unary(Op::neg, x)}));
  }
  const support::Leaf leaf("leaf", [](Leaf&) {});
  std::vector<double> out(2);
  World{.x = {3.0}}.show([&](const At& at) { function(leaf, at, VectorRef(out.data(), 2)); });
  CHECK(out == std::vector{9.0, -3.0});
}

TEST_CASE("as many values at once as there are, whatever their number", "[tape]") {
  for (const int n : {1, 5, 100, 300, 3000}) {
    Graph g;
    const Tape tape = Tape(g, many_at_once(g, n));
    World world;
    for (int i = 0; i < n; ++i) world.x.push_back(0.1 * i);
    double forwards = 1.0, backwards = 2.0;
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      forwards = std::sin(world.x[k]) - forwards;
      backwards = std::sin(world.x[world.x.size() - 1 - k]) - backwards;
    }
    CHECK(values_of(tape, world) == std::vector{forwards, backwards});
  }
}

TEST_CASE("many inputs", "[tape]") {
  Graph g;
  World world;
  Node sum = g.constant(0.5);
  for (int k = 0; k < 40; ++k) {
    sum = g.binary(Op::add, sum, g.input(39 - k, 1));
    world.u.push_back({99.0, static_cast<double>(k)});
  }
  CHECK(values_of(tape_of(g, {sum}), world) == std::vector{780.5});
}

TEST_CASE("a deep expression needs no deep stack", "[tape]") {
  Graph g;
  Node node = g.continuous_state(0);
  for (int i = 0; i < 200000; ++i) node = g.binary(Op::add, node, g.parameter(i % 2));
  const Tape tape = tape_of(g, {node});
  CHECK(values_of(tape, {.x = {0.0}, .p = {1.0, -1.0}}) == std::vector{0.0});
  CHECK(jacobian(tape).entries.size() == 1);
}

TEST_CASE("nothing is allocated after the first call", "[tape][absent]") {
  for (const int n : {2, 3000}) {
    Graph g;
    const Tape tape = Tape(g, many_at_once(g, n));
    std::vector<double> out(2);
    World{.x = std::vector<double>(static_cast<std::size_t>(n), 0.5)}.show([&](const At& at) {
      tape.evaluate(at, out.data());
      CHECK(allocations_of([&] {
              for (int i = 0; i < 100; ++i) tape.evaluate(at, out.data());
            }) <= 0);
    });
  }
}

TEST_CASE("threads run one tape at once", "[tape]") {
  const int n = 1000;
  Graph g;
  const Tape tape = Tape(g, many_at_once(g, n));
  const auto run = [&](double start) {
    World world;
    for (int i = 0; i < n; ++i) world.x.push_back(start + i);
    return values_of(tape, world);
  };
  const std::vector<std::vector<double>> alone = {run(0.0), run(0.5)};
  int wrong[2] = {0, 0};
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < 2; ++k) {
      threads.emplace_back([&, k] {
        for (int i = 0; i < 200; ++i) wrong[k] += run(0.5 * static_cast<double>(k)) != alone[k];
      });
    }
  }
  CHECK(wrong[0] + wrong[1] == 0);
}

TEST_CASE("a person can read a tape", "[tape]") {
  Graph g;
  const Node x = g.continuous_state(0);
  const Node root = g.unary(Op::sqrt, g.binary(Op::add, g.constant(2.5), g.input(1, 3)));
  const std::string lines = tape_of(g, {root, x}).to_string();
  CHECK_THAT(lines, Contains("sqrt(") && Contains("2.5") && Contains("u[1][3]"));
  CHECK_THAT(lines, Contains("out[1] = x[0]"));
}
