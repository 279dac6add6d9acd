// Semantics 4.3, 4.5: predictions at any tolerance; what a write to a held leaf does.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A ball at rest on its floor whose state an update sets at 1 s.
Results touched(double y, double v, double end, Method method) {
  const Leaf ball("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -10.0; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
    l.declare_one_shot(1.0, [=](const At&, Next& next) { next.set_continuous_state({y, v}); });
  });
  return simulate(ball, ball.create_context(), {0.0, end},
                  {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
}

}  // namespace

TEST_CASE("4.3 the prediction is exact however early the tolerance begins the hold",
          "[semantics]") {
  const double tolerance = GENERATE(0.1, 1e-3, 1e-5);
  for (const BallScene& scene : all_forms({.g = 10.0, .e = 0.5, .zeno_tolerance = tolerance})) {
    INFO(scene.form << ", zeno_tolerance " << tolerance);
    const auto results =
        simulate(*scene.system, scene.context(0.2, 0.0), {0.0, 1.0},
                 {.rtol = 1e-10, .atol = 1e-14, .ode_solver_method = Method::dopri5});
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      const Event event = results.events[i];
      if (event.kind != EventKind::zeno_enter) continue;
      CHECK_THAT(event.predicted, WithinAbs(0.6, 1e-9));
      CHECK(event.time < event.predicted);
    }
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.0, 1e-9));
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(0.0, 1e-9));
  }
}

TEST_CASE("4.5 an update that lifts a held ball releases it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto results = touched(2.0, 0.0, 1.2, method);
  CHECK(results.events.times("bounce", EventKind::zeno_release) == std::vector{1.0});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(1.8, 1e-7));
}

TEST_CASE("4.5 an update that kicks a held ball releases it: the flow leads to the armed side",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto results = touched(0.0, 3.0, 1.2, method);
  CHECK(results.events.times("bounce", EventKind::zeno_release) == std::vector{1.0});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.4, 1e-7));
}

TEST_CASE("4.5 an update that throws a held ball at its floor makes it bounce", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // In contact and headed down with 3 m/s: up with 1.5 m/s at the same instant (2.3).
  const auto results = touched(0.0, -3.0, 1.2, method);
  CHECK(results.events.times("bounce", EventKind::zeno_release) == std::vector{1.0});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(1.5 * 0.2 - 5.0 * 0.04, 1e-7));
}

TEST_CASE("4.5 a held ball is released when its force turns, after no force as well",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.5), between = GENERATE(0.0, 1e-9, -1e-9, -3.0);
  INFO("method " << method << ", e = " << e << ", force between " << between);
  const Leaf ball("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], at.z[0]; }});
    l.declare_discrete_state(vec({-10.0}));
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
    l.declare_one_shot(1.0, [=](const At&, Next& next) { next.set_discrete_state({between}); });
    l.declare_one_shot(2.0, [=](const At&, Next& next) { next.set_discrete_state({10.0}); });
  });
  const auto results = simulate(ball, ball.create_context(), {0.0, 2.5},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  // 5 t^2 after the force has turned; a force of 1e-9 for a second adds less than 1e-9 to it
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(1.25, 1e-7));
}
