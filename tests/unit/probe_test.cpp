// Blocks that declare no sparsity: found by calls, never at the price of the answer.
#include "saltus/solver/detail/probe.hpp"

#include <random>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr Index n = 300;

/// xdot_i = -x_i + the sum over row i of x_j^2 / n, of which nothing is declared.
Leaf leaf_of(const std::vector<MatrixEntry>& entries, double start) {
  return Leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state({.initial = Eigen::VectorXd::Constant(n, start),
                                .ode = [entries](const At& at, VectorRef xdot) {
                                  xdot = -at.x;
                                  for (const auto& [i, j] : entries)
                                    xdot[i] += at.x[j] * at.x[j] / static_cast<double>(n);
                                }});
  });
}

std::vector<MatrixEntry> arrow() {
  std::vector<MatrixEntry> entries;
  for (Index k = 1; k < n; ++k) entries.push_back({0, k}), entries.push_back({k, 0});
  return entries;
}

std::vector<MatrixEntry> random_entries() {
  std::mt19937 draw(5);
  std::vector<MatrixEntry> entries;
  for (Index k = 0; k < 3 * n; ++k)
    entries.push_back({static_cast<Index>(draw() % n), static_cast<Index>(draw() % n)});
  return entries;
}

Eigen::MatrixXd ones_at(const std::vector<MatrixEntry>& entries) {
  Eigen::MatrixXd ones = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [i, j] : entries) ones(i, j) = 1.0;
  return ones;
}

struct Looked {
  FoundBlocks found;
  std::string words;
  std::int64_t calls = 0;
};

Looked look_at(const System& system) {
  Machine machine(compile(system));
  machine.load(system.create_context());
  machine.evaluate_instant(0.0);
  Probe probe(machine);
  const bool news = probe.look(0.0, machine.x.data());
  CHECK(news == !probe.found().empty());
  const std::int64_t calls = machine.rhs_calls;
  CHECK(!probe.look(0.0, machine.x.data()));  // nothing new at the same state
  return {probe.found(), probe.words(), calls};
}

Results run(const System& system, double t_end, bool find, double rtol = 1e-6) {
  return simulate(
      system, system.create_context(), {0.0, t_end},
      {.rtol = rtol, .atol = rtol, .ode_solver_method = Method::bdf, .find_sparsity = find});
}

/// A row of beads, each drawn home and pushed by the one before it once that is nearer than 0.5;
/// at the start all are home and none touches.
Leaf beads() {
  return Leaf("beads", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Zero(n), .ode = [](const At& at, VectorRef xdot) {
           xdot = -at.x;
           xdot[0] += 5.0;
           for (Index i = 1; i < n; ++i)
             xdot[i] += 1e4 * std::max(0.0, at.x[i - 1] - at.x[i] - 0.5);
         }});
  });
}

}  // namespace

TEST_CASE("what is found is the sparsity of the function", "[probe]") {
  for (const auto& entries : {band_entries(n, 1, 1), arrow(), random_entries()}) {
    // At 0 all entries but the diagonal vanish.
    for (const double start : {0.7, 0.0, -2.0}) {
      const Looked looked = look_at(leaf_of(entries, start));
      REQUIRE(looked.found.size() == 1);
      std::vector<MatrixEntry> expected = entries;
      for (Index i = 0; i < n; ++i) expected.push_back({i, i});
      CHECK(ones_at(looked.found.at(0)) == ones_at(expected));
    }
  }
}

TEST_CASE("who declares, or is small, is not looked at", "[probe]") {
  const auto ode = [](const At& at, VectorRef xdot) { xdot = -at.x; };
  const auto looked = [&](Index size, auto declare) {
    return look_at(Leaf("leaf", [&](Leaf& l) {
      l.declare_continuous_state({.initial = Eigen::VectorXd::Ones(size), .ode = ode});
      declare(l);
    }));
  };
  const auto nothing = [](Leaf&) {};
  CHECK(looked(n, nothing).calls > 0);
  for (const Looked& left :
       {looked(256, nothing),
        looked(n, [](Leaf& l) { l.declare_jacobian_sparsity(band_entries(n, 1, 1)); }),
        looked(n, [](Leaf& l) {
          l.declare_jacobian([](const At&, MatrixRef j) { j = -Eigen::MatrixXd::Identity(n, n); });
        })}) {
    CHECK(left.calls == 0);
    CHECK(left.found.empty());
    CHECK(left.words.empty());
  }
}

TEST_CASE("a full block is seen to be full in fewer calls than a Jacobian costs", "[probe]") {
  const Looked looked = look_at(Leaf("mean", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n),
         .ode = [](const At& at, VectorRef xdot) { xdot.setConstant(at.x.sum()); }});
  }));
  CHECK(looked.found.empty());
  CHECK(looked.calls < 1000);
  CHECK(contains(looked.words, "block 'mean' declares no sparsity"));
  CHECK(contains(looked.words, "reads nearly everything"));
}

TEST_CASE("places that show only later are found then, and the answer stays right", "[probe]") {
  const Eigen::VectorXd exact = run(beads(), 10.0, false, 1e-9).context.continuous_state();
  REQUIRE(exact[5] > 1.0);  // pushed
  const Results results = run(beads(), 10.0, true);
  INFO(results.statistics.linear_solver);
  // Every bead ends at rest, where errors made on the way have died out: a few tolerances
  // 1e-6 (1 + |x|), |x| <= 5, are left, and of each of the ten beads that touch the one before.
  CHECK((results.context.continuous_state() - exact).cwiseAbs().maxCoeff() < 60e-6);
  CHECK(contains(results.statistics.linear_solver, "band: n = 300"));
  // The diagonal shows at the start, ten or so of the others when beads touch.
  CHECK(results.statistics.jacobian_calls > 0);
  CHECK(!contains(results.statistics.linear_solver, "found 300 places"));
}

TEST_CASE("what a block throws beside the state ends no run and is told", "[probe]") {
  const Leaf shy("shy", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n), .ode = [](const At& at, VectorRef xdot) {
           if (at.time == 0.0 && at.x[7] != 1.0) throw std::domain_error("x[7] has to begin at 1");
           xdot = -at.x;
         }});
  });
  const Results results = run(shy, 1.0, true);
  CHECK(results.status == Status::reached_end);
  CHECK_THAT(results.context.continuous_state()[7], WithinAbs(std::exp(-1.0), 1e-4));
  CHECK(contains(results.statistics.linear_solver, "dense: n = 300"));
  CHECK(contains(results.statistics.linear_solver,
                 "block 'shy' declares no sparsity, 1 calls did not find it (it threw: x[7] has to "
                 "begin at 1)"));
}

TEST_CASE("what it throws farther away costs the farther point only", "[probe]") {
  const Looked looked = look_at(Leaf("near", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n), .ode = [](const At& at, VectorRef xdot) {
           if (at.x[7] > 1.001) throw std::domain_error("too far");
           xdot = -at.x;
         }});
  }));
  CHECK(looked.found.at(0).size() == n);
  CHECK(contains(looked.words, "it threw: too far"));
}

TEST_CASE("an interruption passes through", "[probe]") {
  struct Stop : std::runtime_error, Interruption {
    Stop() : std::runtime_error("stop") {}
  };
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n), .ode = [](const At& at, VectorRef xdot) {
           if (at.time == 0.0 && at.x[7] != 1.0) throw Stop();
           xdot = -at.x;
         }});
  });
  CHECK_THROWS_AS(run(leaf, 1.0, true), Stop);
}

TEST_CASE("a derivative that is not finite beside the state is left alone", "[probe]") {
  const Looked looked = look_at(Leaf("edge", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n),
         .ode = [](const At& at, VectorRef xdot) { xdot = (1.0 - at.x.array()).sqrt(); }});
  }));
  CHECK(looked.found.empty());
  CHECK(contains(looked.words, "the derivative beside the state is not finite"));
}

TEST_CASE("what was found is given up where Newton's iteration fails, and the failure is told",
          "[probe]") {
  // All but a relay, and a step that may not become short enough for it.
  const Leaf relay("relay", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n), .ode = [](const At& at, VectorRef xdot) {
           xdot = -1e3 * (1e9 * (at.x.array() - 1.0 - std::sin(at.time))).atan();
         }});
  });
  const Results results = simulate(relay, relay.create_context(), {0.0, 1.0},
                                   {.rtol = 1e-3,
                                    .atol = 1e-6,
                                    .ode_solver_method = Method::bdf,
                                    .min_minor_step_size = 1e-2,
                                    .throw_errors = false});
  CHECK(results.status == Status::failed);
  CHECK(contains(results.message, "below min_minor_step_size"));
  CHECK(contains(results.statistics.linear_solver, "dense: n = 300"));
  CHECK(contains(results.statistics.linear_solver,
                 "(Newton's iteration did not converge with what was found)"));
}

TEST_CASE("find_sparsity = false asks for no call", "[probe]") {
  const Results off = run(leaf_of(band_entries(n, 1, 1), 0.7), 1.0, false);
  CHECK(contains(off.statistics.linear_solver, "dense: n = 300, 90000 places"));
  CHECK(!contains(off.statistics.linear_solver, "declares no sparsity"));
  const Results on = run(leaf_of(band_entries(n, 1, 1), 0.7), 1.0, true);
  CHECK(contains(on.statistics.linear_solver, "band: n = 300, 898 places, 3 colours"));
}
