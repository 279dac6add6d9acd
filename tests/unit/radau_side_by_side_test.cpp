// The matrices of a step in two threads: when, and that no bit depends on it.
#include "saltus/solver/detail/radau/side_by_side.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>

#include "saltus/simulation/ensemble.hpp"
#include "saltus/solver/detail/one_thread.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A chain of n fast states that pulls each to its neighbours, all coupled by their mean.
Leaf chain(Index n) {
  return Leaf("chain", [n](Leaf& l) {
    l.declare_continuous_state({.initial = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0),
                                .ode = [n](const At& at, VectorRef xdot) {
                                  xdot = -1e3 * (at.x.array() - std::sin(at.time)) *
                                         (1.0 + at.x.array().square());
                                  xdot.array() += at.x.mean();
                                  xdot.tail(n - 1) += 100.0 * at.x.head(n - 1);
                                }});
  });
}

SimulatorOptions options() {
  return {.rtol = 1e-6, .ode_solver_method = Method::radau, .linear_solver = LinearSolver::dense};
}

}  // namespace

TEST_CASE("matrices are factorised side by side where it pays, on two cores", "[radau]") {
  using radau::side_by_side;
  // 5 ms are 1.16 ms of a real and 3.84 ms of a complex matrix, or 0.46 ms and three of 1.51 ms.
  CHECK_FALSE(side_by_side(1.1e6, 1, 2, false));
  CHECK(side_by_side(1.2e6, 1, 2, false));
  CHECK_FALSE(side_by_side(0.45e6, 3, 2, false));
  CHECK(side_by_side(0.47e6, 3, 2, false));
  CHECK_FALSE(side_by_side(1e9, 3, 1, false));
  CHECK_FALSE(side_by_side(1e9, 3, 0, false));  // a machine that does not say
  CHECK_FALSE(side_by_side(1e9, 3, 2, true));
}

TEST_CASE("both pieces of work are done, and what they throw is thrown", "[radau]") {
  for (const bool apart : {false, true}) {
    std::thread::id first, second;
    radau::call_both(
        apart, [&] { first = std::this_thread::get_id(); },
        [&] { second = std::this_thread::get_id(); });
    CHECK(first == std::this_thread::get_id());
    CHECK((second != first) == apart);
    CHECK(second != std::thread::id());
    const auto fail = [] { throw std::runtime_error("no"); };
    CHECK_THROWS_AS(radau::call_both(apart, fail, [] {}), std::runtime_error);
    CHECK_THROWS_AS(radau::call_both(apart, [] {}, fail), std::runtime_error);
  }
}

TEST_CASE("a large system has the same bits in one thread and in two", "[radau]") {
  // 0.06 ns 300^3 + 3 ns 300^2 = 1.9 ms, from which on all orders use two threads.
  const Leaf leaf = chain(300);
  const auto run = [&] {
    return simulate(leaf, leaf.create_context(), {0.0, 0.01}, options()).context.continuous_state();
  };
  const Eigen::VectorXd two = run();
  const OneThread alone;
  CHECK(run() == two);
}

TEST_CASE("an ensemble that has the cores asks its runs for one thread", "[radau]") {
  std::atomic<int> asked = 0, calls = 0;
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [&](const At& at) {
                                  ++calls, asked += OneThread::asked() ? 1 : 0;
                                  return -at.x[0];
                                }});
  });
  Ensemble ensemble(leaf, leaf.create_context(), {0.0, 1.0});
  ensemble.vary("x[0]", {1.0, 2.0, 3.0, 4.0});
  for (const int threads : {1, 2}) {
    asked = calls = 0;
    ensemble.run([](Index, const Results&) {}, {.threads = threads});
    CHECK(calls > 0);
    CHECK(asked == calls);
    CHECK_FALSE(OneThread::asked());
  }
}
