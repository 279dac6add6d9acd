// Steps that are too long for their dense output: seen, and drawn in two halves, for whoever looks.
#include "saltus/plan/compile.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/solver/detail/dop853.hpp"
#include "saltus/solver/detail/runge_kutta.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// x' = -100 (x - cos t): on the slow manifold, x = (1e4 cos t + 100 sin t) / 10001, the steps are
/// as long as stability allows.
Leaf fast_lag() {
  return Leaf("lag", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1e4 / 10001.0}), .ode = [](const At& at) {
                                  return -100.0 * (at.x[0] - std::cos(at.time));
                                }});
    l.declare_continuous_state_output("x");
  });
}
double on_manifold(double t) { return (1e4 * std::cos(t) + 100.0 * std::sin(t)) / 10001.0; }

}  // namespace

TEST_CASE("DOP853's dense output is as good as its steps where stability makes them long",
          "[dop853]") {
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8);
  const Leaf leaf = fast_lag();
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  GuardSet guards;
  RungeKutta<Dop853> solver(machine, guards, {.rtol = rtol, .atol = rtol});
  solver.restart(0.0, machine.x, {.first = true});
  double ends = 0.0, inside = 0.0, x = 0.0;
  while (solver.time() < 3.0) {
    const double t0 = solver.time();
    solver.advance(3.0);
    const double h = solver.time() - t0;
    ends = std::max(ends, std::abs(solver.state()[0] - on_manifold(solver.time())));
    for (int i = 1; i < 20; ++i) {
      solver.interpolate(t0 + 0.05 * i * h, &x);
      inside = std::max(inside, std::abs(x - on_manifold(t0 + 0.05 * i * h)));
    }
  }
  // The errors of the steps before die out within one: |R| <= 1. What the polynomials may miss by,
  // four tolerances, is of their share of the ten.
  CHECK(ends <= 5.0 * 2.0 * rtol);
  CHECK(inside <= 10.0 * 2.0 * rtol);
  CHECK(solver.statistics().steps > 45);  // 300 / 6.1 of them: accuracy alone would take a dozen
}

TEST_CASE("looking into steps of DOP853 changes no bit of them", "[dop853]") {
  const auto ends = [](bool looks) {
    const Leaf leaf = fast_lag();
    Machine machine(compile(leaf));
    machine.load(leaf.create_context());
    GuardSet guards;
    RungeKutta<Dop853> solver(machine, guards, {.rtol = 1e-5, .atol = 1e-5});
    solver.restart(0.0, machine.x, {.first = true});
    std::vector<double> all;
    for (double x = 0.0; solver.time() < 3.0;) {
      const double t0 = solver.time();
      solver.advance(3.0);
      if (looks) solver.interpolate(0.5 * (t0 + solver.time()), &x);
      all.push_back(solver.time()), all.push_back(solver.state()[0]);
    }
    return all;
  };
  CHECK(ends(true) == ends(false));
}

TEST_CASE("the dense output of DOP853 is continuous in the middle of a step, and at its end",
          "[dop853]") {
  const Leaf leaf = fast_lag();
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  GuardSet guards;
  RungeKutta<Dop853> solver(machine, guards, {.rtol = 1e-4, .atol = 1e-4});
  solver.restart(0.0, machine.x, {.first = true});
  int joints = 0;
  while (solver.time() < 3.0) {
    const double t0 = solver.time();
    solver.advance(3.0);
    const double joint = solver.joint(), t1 = solver.time();
    for (const double t : {joint, t1}) {
      if (!(t > t0)) continue;
      joints += t == joint;
      double before = 0.0, after = 0.0;
      solver.interpolate(t - 1e-12, &before), solver.interpolate(t, &after);
      // |x'| < 1 + 100 times twenty tolerances.
      CHECK_THAT(after, WithinAbs(before, 2e-12));
    }
  }
  CHECK(joints > 0);
}

TEST_CASE("dense output follows a step that is drawn in two halves", "[dense]") {
  const Leaf lag = fast_lag();
  const auto times = [] {
    std::vector<double> inner;
    for (int i = 0; i < 997; ++i) inner.push_back(3.0 * (i + 0.5) / 997);
    return inner;
  }();
  const auto run = [&](SimulatorOptions options) {
    options.rtol = options.atol = 1e-4, options.ode_solver_method = Method::dop853;
    options.recorded_signals = {{"x", lag.output(0)}};
    return simulate(lag, lag.create_context(), {0.0, 3.0}, options);
  };
  const auto rows = run({.save_at = times}), dense = run({.dense_output = true});
  const auto x = rows.output("x");
  for (std::size_t i = 0; i < times.size(); ++i)  // a polynomial rebuilt from Chebyshev points
    CHECK_THAT(dense.at(times[i]).output("x")[0],
               WithinAbs(x(static_cast<Index>(i) + 1, 0), 50.0 * eps));
}
