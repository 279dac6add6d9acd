// DOPRI5: its coefficients, order 5 of the step, order 4 of the dense output, on a nonlinear
// problem.
#include "saltus/solver/detail/dopri5.hpp"
#include "support/convergence.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

TEST_CASE("the coefficients of DOPRI5 are consistent: rows sum to c, weights to 1", "[dopri5]") {
  CHECK(worst_row_sum<Dopri5>() < 30.0 * eps);  // rows have entries up to 12
  for (int k = 0; k < 5; ++k)
    CHECK_THAT(moment<Dopri5>(Dopri5::a[6], k), WithinAbs(1.0 / (k + 1), 4.0 * eps));
  for (int k = 0; k < 4; ++k)
    CHECK_THAT(moment<Dopri5>(Dopri5::e[0], k), WithinAbs(0.0, 4.0 * eps));
  CHECK_THAT(moment<Dopri5>(Dopri5::d[0], 0), WithinAbs(0.0, 40.0 * eps));
}

TEST_CASE("the error of the step falls with h^5, that of the dense output with h^5 too, or h^4",
          "[dopri5]") {
  const StepErrors coarse = step_errors<Dopri5>(8), fine = step_errors<Dopri5>(16),
                   finest = step_errors<Dopri5>(32);
  INFO("ends " << coarse.ends << " " << fine.ends << " " << finest.ends);
  INFO("inside " << coarse.inside << " " << fine.inside << " " << finest.inside);
  CHECK(order(coarse.ends, fine.ends) > 4.5);
  CHECK(order(fine.ends, finest.ends) > 4.5);
  CHECK(order(coarse.inside, fine.inside) > 3.7);
  CHECK(order(fine.inside, finest.inside) > 3.7);
}

TEST_CASE("the achieved error stays within ten tolerances, by any one-step method", "[dopri5]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::automatic);
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
    CHECK_THAT(x[i], WithinAbs(logistic_at(results.time[i]), 10.0 * 4.0 * rtol));
}

TEST_CASE("a right-hand side of degree four in time is integrated exactly", "[dopri5]") {
  const Leaf leaf("quartic", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return 5.0 * std::pow(at.time, 4.0); }});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = Method::dopri5});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(1.0, 1e-14));
}
