// A fast part that follows a slow solution: x' = -lambda (x - cos t) - sin t, x(0) = 1, is x = cos
// t.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Followed {
  double error = 0.0;  // [tolerances] the largest at a step
  long steps = 0, rejected = 0;
};

Followed follow(double lambda, double rtol) {
  const Leaf leaf("leaf", [lambda](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [lambda](const At& at) {
                                  return -lambda * (at.x[0] - std::cos(at.time)) -
                                         std::sin(at.time);
                                }});
    l.declare_continuous_state_output("x");
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 10.0},
                                {.rtol = rtol,
                                 .atol = rtol,
                                 .ode_solver_method = Method::radau,
                                 .recorded_signals = {{"x", leaf.output(0)}},
                                 .save_steps = true});
  Followed run{.steps = results.statistics.steps, .rejected = results.statistics.rejected};
  const auto x = results.output("x");
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    const double exact = std::cos(results.time[i]);
    const double error = std::abs(x(static_cast<Index>(i), 0) - exact);
    run.error = std::max(run.error, error / (rtol + rtol * std::abs(exact)));
  }
  return run;
}

}  // namespace

TEST_CASE("radau follows a slow solution from however fast a part, and rejects few steps",
          "[radau]") {
  const double lambda = GENERATE(1e2, 1e3, 1e4, 1e5, 1e6, 1e8);
  const double rtol = GENERATE(1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12);
  const Followed run = follow(lambda, rtol);
  INFO("lambda " << lambda << " rtol " << rtol << ": error " << run.error << ", " << run.steps
                 << " steps, " << run.rejected << " rejected");
  // A step may leave two tolerances in a fast part. Its estimate has the leading term only, which
  // the next terms of h may double; where h lambda is near gamma, some steps add up.
  CHECK(run.error < 6.0);
  // Four steps in five are right at once: the length is that for 0.9^(S + 1) = 0.4 to 0.66 of what
  // is allowed, and cos changes its higher derivatives by more than that at few places. Two more
  // may be rejected where a run has less than ten steps.
  CHECK(5 * run.rejected <= run.steps + run.rejected + 10);
}
