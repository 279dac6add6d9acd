// DOPRI5: its coefficients, order 5 of the step, order 4 of the dense output, on a nonlinear
// problem.
#include "saltus/solver/dopri5.hpp"
#include "saltus/solver/dopri5.hpp"
#include "saltus/solver/runge_kutta.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// x' = x (1 - x), x(0) = 0.1: the logistic equation.
Leaf logistic() {
  return Leaf("logistic", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.1}), .ode = [](const At& at) { return at.x[0] * (1.0 - at.x[0]); }});
    l.declare_continuous_state_output("x");
  });
}
double exact(double t) { return 1.0 / (1.0 + 9.0 * std::exp(-t)); }

/// Largest error at the ends of n equal steps to t = 4, and at eight points inside each.
struct Errors {
  double ends = 0.0, inside = 0.0;
};
Errors errors(int n) {
  const Leaf leaf = logistic();
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  Watch watch;
  const double h = 4.0 / n;
  // A tolerance that everything meets: the steps are h.
  RungeKutta<Dopri5> solver(machine, watch, {.rtol = 1e6, .atol = 1e6, .max_step = h});
  solver.restart(0.0, machine.x, {.first = true});
  Errors worst;
  for (int i = 1; i <= n; ++i) {
    const double end = h * i;
    while (solver.time() < end) solver.advance(end);
    worst.ends = std::max(worst.ends, std::abs(solver.state()[0] - exact(end)));
    for (int k = 1; k < 9; ++k) {
      double x = 0.0;
      const double t = end - h + h * k / 9.0;
      solver.interpolate(t, &x);
      worst.inside = std::max(worst.inside, std::abs(x - exact(t)));
    }
  }
  CHECK(solver.statistics().steps <= n + 5);  // the first ones are shorter
  return worst;
}

}  // namespace

TEST_CASE("the coefficients of DOPRI5 are consistent: rows sum to c, weights to 1", "[dopri5]") {
  for (std::size_t i = 0; i < Dopri5::stages; ++i) {
    double sum = 0.0;
    for (const double a : Dopri5::a[i]) sum += a;
    CHECK_THAT(sum, WithinAbs(Dopri5::c[i], 30.0 * eps));  // rows have entries up to 12
  }
  double error = 0.0, dense = 0.0;
  for (std::size_t i = 0; i < Dopri5::stages; ++i) error += Dopri5::e[i], dense += Dopri5::d[i];
  CHECK_THAT(error, WithinAbs(0.0, 4.0 * eps));
  CHECK_THAT(dense, WithinAbs(0.0, 40.0 * eps));
}

TEST_CASE("the error of the step falls with h^5, that of the dense output with h^5 too, or h^4",
          "[dopri5]") {
  // The observed order is the logarithm of the ratio, to base 2, when steps are halved.
  const Errors coarse = errors(8), fine = errors(16), finest = errors(32);
  const auto order = [](double a, double b) { return std::log2(a / b); };
  INFO("ends " << coarse.ends << " " << fine.ends << " " << finest.ends);
  INFO("inside " << coarse.inside << " " << fine.inside << " " << finest.inside);
  CHECK(order(coarse.ends, fine.ends) > 4.5);
  CHECK(order(fine.ends, finest.ends) > 4.5);
  CHECK(order(coarse.inside, fine.inside) > 3.7);
  CHECK(order(fine.inside, finest.inside) > 3.7);
}

TEST_CASE("the achieved error stays within ten tolerances, by any method", "[dopri5]") {
  const auto* method = GENERATE("dopri5", "auto");
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8, 1e-10);
  INFO("method " << method << ", rtol " << rtol);
  const Leaf leaf = logistic();
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 4.0},
                                {.rtol = rtol,
                                 .atol = 0.01 * rtol,
                                 .ode_solver_method = method,
                                 .recorded_signals = {{"x", leaf.output()}}});
  const auto x = column(results, "x");
  // Growth of the logistic equation from 0.1 to 0.5: e^2.2 / 4 or so, below 4.
  for (std::size_t i = 0; i < x.size(); ++i)
    CHECK_THAT(x[i], WithinAbs(exact(results.time[i]), 10.0 * 4.0 * rtol));
}

TEST_CASE("a right-hand side of degree four in time is integrated exactly", "[dopri5]") {
  const Leaf leaf("quartic", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return 5.0 * std::pow(at.time, 4.0); }});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = "dopri5"});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(1.0, 1e-14));
}
