// Starts on, below and above the floor: what a guard at zero, or beyond it, does at t0.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {
constexpr double g = 10.0;
}

TEST_CASE("a ball thrown up from the floor flies and comes back", "[laws][ball][start]") {
  const auto method = GENERATE(from_range(methods));
  const double floor = GENERATE(0.0, 0.3);
  for (const BallScene& scene : all_forms({.g = g, .e = 0.5, .floor = floor})) {
    INFO(scene.form << ", method " << method << ", floor " << floor);
    const double rtol = 1e-9, atol = 1e-11;
    const auto results = simulate(*scene.system, scene.context(floor, 5.0), {0.0, 1.25},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // Up for 1 s, then 0.25 s of a flight that starts with 2.5 m/s.
    const double tolerance = 100.0 * (rtol * 5.0 + atol);
    CHECK_THAT(results.context.continuous_state()[0],
               WithinAbs(floor + 2.5 * 0.25 - 5.0 * 0.0625, tolerance));
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(0.0, 10.0 * tolerance));
    CHECK(count(results.events, EventKind::zeno_enter) == 0);
  }
}

TEST_CASE("a ball thrown down on the floor it touches bounces at once, at t0",
          "[laws][ball][start]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.g = g, .e = 0.5})) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(0.0, -4.0), {0.0, 0.2},
                                  {.ode_solver_method = method});
    REQUIRE(!results.events.empty());
    CHECK_THAT(results.events[0].time, WithinAbs(0.0, 1e-12));
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(2.0 - g * 0.2, 1e-6));
  }
}

TEST_CASE("a ball that starts below the floor is not invented a bounce", "[laws][ball][start]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.g = g, .e = 0.5})) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(-1.0, -1.0), {0.0, 1.0},
                                  {.ode_solver_method = method});
    CHECK(results.events.empty());
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(-1.0 - 1.0 - 5.0, 1e-4));
  }
}

TEST_CASE("a ball thrown up from below the floor passes it, then bounces on it",
          "[laws][ball][start]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.g = g, .e = 0.5})) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(-1.0, 6.0), {0.0, 1.1},
                                  {.ode_solver_method = method});
    const double contact = 1.0;  // -1 + 6 t - 5 t^2 = 0 at 0.2 s, going up, and at 1 s
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(2.0 - g * (1.1 - contact), 1e-4));
  }
}

TEST_CASE("a first impact right after the start is a bounce, not a Zeno hold",
          "[laws][ball][start]") {
  const double t0 = GENERATE(0.0, -5.0, 1e6);
  for (const BallScene& scene : all_forms({.g = g, .e = 0.5})) {
    INFO(scene.form << ", t0 = " << t0);
    const auto results = simulate(*scene.system, scene.context(1e-7, -10.0, t0), {t0, t0 + 0.1},
                                  {.ode_solver_method = Method::dopri5});
    CHECK(count(results.events, EventKind::zeno_enter) == 0);
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(5.0 - 1.0, 1e-6));
  }
}

TEST_CASE("a run from t = -5 s is the run from 0, moved", "[laws][ball][start]") {
  const auto method = GENERATE(from_range(methods));
  const BallScene scene = leaf({.g = g, .e = 0.7});
  const SimulatorOptions options{.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method};
  const auto moved = simulate(*scene.system, scene.context(5.0, 0.0, -5.0), {-5.0, 0.0}, options);
  const auto still = simulate(*scene.system, scene.context(5.0, 0.0), {0.0, 5.0}, options);
  REQUIRE(moved.events.size() == still.events.size());
  for (std::size_t i = 0; i < moved.events.size(); ++i) {
    CHECK_THAT(moved.events[i].time + 5.0, WithinAbs(still.events[i].time, 1e-7));
  }
}
