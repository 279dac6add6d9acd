// DOP853: its coefficients, order 8 of the step, order 7 of the dense output, what its extra stages
// cost and when.
#include "saltus/solver/detail/dop853.hpp"
#include "saltus/plan/compile.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "support/convergence.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// x' = f(t) and the machine that steps it; x(0) = 0.
struct Bare {
  template <class Ode>
  explicit Bare(Ode f, double max_step = infinite, double tolerance = 1e6)
      : leaf("bare",
             [&](Leaf& l) { l.declare_continuous_state({.initial = vec({0.0}), .ode = f}); }),
        machine(compile(leaf)),
        solver(machine, guards, {.rtol = tolerance, .atol = tolerance, .max_step = max_step}) {
    machine.load(leaf.create_context());
    solver.restart(0.0, machine.x, {.first = true});
  }
  Leaf leaf;
  Machine machine;
  GuardSet guards;
  RungeKutta<Dop853> solver;
};

}  // namespace

TEST_CASE("the coefficients of DOP853 satisfy their order conditions", "[dop853]") {
  // Rows have entries up to 44 and twelve terms: 44 * 12 roundings of eps / 2.
  CHECK(worst_row_sum<Dop853>() < 264.0 * eps);
  // Quadrature of order 8; weights up to 5.8, eight of them.
  for (int k = 0; k < 8; ++k)
    CHECK_THAT(moment<Dop853>(Dop853::a[12], k), WithinAbs(1.0 / (k + 1), 25.0 * eps));
  // Both estimates vanish for every quadrature the embedded formulas do exactly.
  for (int k = 0; k < 5; ++k)
    CHECK_THAT(moment<Dop853>(Dop853::e[0], k), WithinAbs(0.0, 25.0 * eps));
  for (int k = 0; k < 3; ++k)
    CHECK_THAT(moment<Dop853>(Dop853::e[1], k), WithinAbs(0.0, 25.0 * eps));
  CHECK(std::abs(moment<Dop853>(Dop853::e[0], 5)) > 1e-6);  // and not beyond
  CHECK(std::abs(moment<Dop853>(Dop853::e[1], 3)) > 1e-6);
  // The dense terms vanish for constant f, which its first three terms give already; entries up to
  // 530, sixteen of them.
  for (const auto& row : Dop853::d)
    CHECK_THAT(moment<Dop853>(row, 0), WithinAbs(0.0, 4300.0 * eps));
}

TEST_CASE("the error of a DOP853 step falls with h^8, that of its dense output with h^7 at least",
          "[dop853]") {
  const StepErrors coarse = step_errors<Dop853>(4), fine = step_errors<Dop853>(8),
                   finest = step_errors<Dop853>(16);
  INFO("ends " << coarse.ends << " " << fine.ends << " " << finest.ends);
  INFO("inside " << coarse.inside << " " << fine.inside << " " << finest.inside);
  CHECK(order(coarse.ends, fine.ends) > 7.5);
  CHECK(order(fine.ends, finest.ends) > 7.5);
  CHECK(order(coarse.inside, fine.inside) > 6.7);
  CHECK(order(fine.inside, finest.inside) > 6.7);
}

TEST_CASE("DOP853's error estimate falls with h^8", "[dop853]") {
  // From estimate e at step h the controller proposes 0.9 h e^(-1/8): were the order another, the
  // steps it takes at tolerances 2^8 apart would not have the ratio 2.
  const auto steps = [](double rtol) {
    const Leaf leaf = logistic();
    return static_cast<double>(simulate(leaf, leaf.create_context(), {0.0, 20.0},
                                        {.rtol = rtol,
                                         .atol = rtol,
                                         .ode_solver_method = Method::dop853,
                                         .max_minor_step_size = 2.0})
                                   .statistics.steps);
  };
  const double ratio = steps(1e-13) / steps(256e-13);
  CHECK(ratio > 1.7);  // the first steps do not shrink with the tolerance
  CHECK(ratio < 2.2);
}

TEST_CASE(
    "a right-hand side of degree seven in time is integrated exactly, its inside to degree six",
    "[dop853]") {
  Bare seventh([](const At& at) { return 8.0 * std::pow(at.time, 7.0); });
  while (seventh.solver.time() < 1.0) seventh.solver.advance(1.0);
  CHECK_THAT(seventh.solver.state()[0], WithinAbs(1.0, 25.0 * eps));  // weights as above
  Bare sixth([](const At& at) { return 7.0 * std::pow(at.time, 6.0); });
  while (sixth.solver.time() < 1.0) sixth.solver.advance(1.0);
  for (const double t : {0.3, 0.6, 0.99}) {  // all may lie in the last step
    double x = 0.0;
    sixth.solver.interpolate(t, &x);
    if (t > 0.98) CHECK_THAT(x, WithinAbs(std::pow(t, 7.0), 7.0 * 4300.0 * eps));  // entries of d
  }
}

TEST_CASE("the dense output meets both ends of the step to the last bit", "[dop853]") {
  const Leaf leaf = logistic();
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  GuardSet guards;
  RungeKutta<Dop853> solver(machine, guards, {.rtol = 1e-8, .atol = 1e-10});
  solver.restart(0.0, machine.x, {.first = true});
  for (int i = 0; i < 8; ++i) {
    const double t0 = solver.time(), x0 = solver.state()[0];
    solver.advance(4.0);
    double x = 0.0;
    solver.interpolate(t0, &x);
    CHECK(x == x0);
    solver.interpolate(solver.time(), &x);
    CHECK(x == solver.state()[0]);
  }
}

TEST_CASE("the three stages of the dense output are computed once, and only if asked for",
          "[dop853]") {
  Bare run([](const At& at) { return std::cos(at.time); }, 0.1);
  for (int i = 0; i < 6; ++i) run.solver.advance(10.0);  // the first steps are shorter
  const auto calls = [&] { return run.machine.rhs_calls; };
  auto before = calls();
  const double t0 = run.solver.time();
  run.solver.advance(10.0);
  CHECK(calls() - before == 12);  // twelve stages less the first, and f(x1)
  before = calls();
  double x = 0.0;
  run.solver.interpolate(t0 + 0.03, &x);
  CHECK(calls() - before == 3);
  run.solver.interpolate(t0 + 0.07, &x);
  CHECK(calls() - before == 3);
}

TEST_CASE("a trial step that is not finite anywhere is shortened, not fatal", "[dop853]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853);
  INFO("method " << method);
  // x' = -sqrt(x), x(0) = 1: x = (1 - t/2)^2, and behind x = 0 nothing.
  const Leaf leaf("tank", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return -std::sqrt(at.x[0]); }});
    l.declare_zero_crossing({.name = "nearly_empty",
                             .guard = [](const At& at) { return at.x[0] - 1e-6; },
                             .direction = Direction::positive_then_non_positive,
                             .terminal = true});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 3.0},
                                {.rtol = 1e-3, .atol = 1e-12, .ode_solver_method = method});
  REQUIRE(results.status == Status::terminal);
  // x = 1e-6 at t = 2 - 2e-3. A relative error r of x moves that time by r sqrt(x) <= r: ten rtol.
  CHECK_THAT(results.context.time(), WithinAbs(1.998, 10.0 * 1e-3));
}
