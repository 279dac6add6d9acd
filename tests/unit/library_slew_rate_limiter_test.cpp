// SlewRateLimiter: its answer to a step in closed form, the lag below the limits, and refusals.
#include <cmath>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

using Options = SlewRateLimiter::Options;

/// A step to 2 at rate 1 and time constant 0.5: a line until 0.5 is left, at 1.5, then exp.
TEST_CASE("a SlewRateLimiter follows a step along a line, then an exponential",
          "[library][nonlinear]") {
  const BlockRun<SlewRateLimiter> scene(fed_by<Constant>(2.0),
                                        Options{.time_constant = 0.5, .initial_state = 0.0});
  const Numbers y = scene.at({0.5, 1.0, 1.5, 2.5});
  CHECK_THAT(y[0], WithinAbs(0.5, solver_tolerance));
  CHECK_THAT(y[1], WithinAbs(1.0, solver_tolerance));
  CHECK_THAT(y[2], WithinAbs(1.5, solver_tolerance));
  CHECK_THAT(y[3], WithinAbs(2.0 - 0.5 * std::exp(-2.0), solver_tolerance));
}

/// The trap: the end of the limit is a kink of the derivative. It is located: the line ends at 1.5.
TEST_CASE("the end of the limit is an event", "[library][nonlinear]") {
  const BlockRun<SlewRateLimiter> scene(fed_by<Constant>(2.0), Options{.time_constant = 0.5});
  const Results results = scene.run(3.0);
  REQUIRE(results.events.size() == 1);
  CHECK_THAT(results.events[0].time, WithinAbs(1.5, rounding));
}

/// Behind a ramp that is slower than the limit y lags by slope times time_constant, once the start
/// has decayed; each entry, and each direction, has its own limit.
TEST_CASE("a SlewRateLimiter lags a slow input, and limits each direction",
          "[library][nonlinear]") {
  const BlockRun<SlewRateLimiter> slow(fed_by<Ramp>(Ramp::Options{.slope = 0.5, .start_time = 0.0}),
                                       Options{.time_constant = 0.1});
  CHECK_THAT(slow.at({5.0})[0], WithinAbs(2.5 - 0.05 * (1.0 - std::exp(-50.0)), solver_tolerance));
  const BlockRun<SlewRateLimiter> two(
      fed_by<Constant>(Value{10.0, -10.0}),
      Options{.lower_limit = -2.0, .upper_limit = 3.0, .initial_state = {0.0, 0.0}});
  const Eigen::VectorXd y = two.run(1.0).context.continuous_state();
  CHECK_THAT(y[0], WithinAbs(3.0, rounding));
  CHECK_THAT(y[1], WithinAbs(-2.0, rounding));
}

TEST_CASE("a SlewRateLimiter refuses what is no limit", "[library][errors]") {
  CHECK(contains(model_error([] { SlewRateLimiter("s", {.lower_limit = 0.5}); }),
                 "expected lower_limit <= 0 <= upper_limit"));
  CHECK(contains(model_error([] { SlewRateLimiter("s", {.time_constant = 0.0}); }),
                 "time_constant = 0 s"));
}
