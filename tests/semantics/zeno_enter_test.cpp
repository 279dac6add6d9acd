// Semantics 4.2, 4.4: when a hold begins, and what a hold is.
#include "saltus/simulation/detail/zeno.hpp"
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

TEST_CASE("4.2 gaps that shrink more slowly than geometrically accumulate too", "[semantics]") {
  ZenoMonitor monitor(1e-6);
  double t = 1.0;
  for (int k = 1; k <= 5; ++k) monitor.fired(t += 1e-6 / (k * k));
  CHECK(monitor.accumulates());
}

TEST_CASE("4.2 a reset that leaves no time to pass holds at once: restitution 0", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.g = 10.0, .e = 0.0})) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(0.2, 0.0), {0.0, 1.0},
                                  {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
    const double contact = results.events[0].time;
    CHECK_THAT(contact, WithinAbs(0.2, 1e-6));
    CHECK(count(results.events, EventKind::zeno_enter) == scene.monitors);
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      // An opaque boolean says nothing at the floor itself: it sees the ball one rounding below.
      CHECK_THAT(results.events[i].time, WithinAbs(contact, 1e-8));
    }
  }
}

TEST_CASE("4.2 a fast rhythm with equal gaps is no hold, below the tolerance and late in time",
          "[semantics]") {
  const auto method = GENERATE(Method::dopri5, Method::automatic);
  const double t0 = GENERATE(0.0, 100.0);
  INFO("method " << method << ", t0 " << t0);
  // A ball with restitution 1 and flights of 4e-7 s: gaps equal but for the rounding of times.
  const Leaf ball("ball", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -5e6; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0, 1.0}); },
         .direction = Direction::positive_then_non_positive});
  });
  const auto results = simulate(ball, ball.create_context(t0), {t0, t0 + 2e-4},
                                {.rtol = 1e-9, .atol = 1e-14, .ode_solver_method = method});
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(std::abs(static_cast<double>(results.events.size()) - 500.0) <= 1.0);
}

TEST_CASE("4.4 on hold the state is the same to the last bit, row after row", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.5, .floor = 0.3})) {
    INFO(scene.form << ", method " << method);
    std::vector<double> times;
    for (int i = 0; i <= 50; ++i) times.push_back(2.0 + 0.1 * i);  // at rest from 1.16 s on
    const auto results = simulate(
        *scene.system, scene.context(1.0, 0.0), {0.0, 7.0},
        {.ode_solver_method = method, .recorded_signals = {{"y", scene.height}}, .save_at = times});
    const auto y = column(results, "y");
    for (const double t : times) {
      for (const std::size_t row : rows_at(results, t))
        CHECK(y[row] == results.context.continuous_state()[0]);
    }
  }
}

TEST_CASE("4.4 an Integrator on hold holds its own state; others of the diagram go on",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const Contact contact : contacts) {
    const BallScene ball = blocks(contact, {.e = 0.5});
    DiagramBuilder builder;
    builder.add(std::const_pointer_cast<System>(ball.system));
    auto& one = builder.add<Constant>("one", 1.0);
    auto& clock = builder.add<Integrator>("clock");
    builder.connect(one.output(), clock.input("in"));
    const Diagram diagram = builder.build();
    const auto results =
        simulate(diagram, diagram.create_context().with_continuous_state({1.0, 0.0, 0.0}),
                 {0.0, 5.0}, {.ode_solver_method = method});
    INFO(ball.form << ", method " << method);
    CHECK(count(results.events, EventKind::zeno_enter) == 2);
    CHECK_THAT(results.context.continuous_state()[2], WithinAbs(5.0, 1e-9));
  }
}
