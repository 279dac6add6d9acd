// The ready scenes against what is known of them, with every method that suits them; and the report
// that compares them.
#include <saltus/models/models.hpp>
#include <saltus/report/achieved.hpp>

#include "support/catch.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Scene at_tolerance(Scene scene, Method method, double rtol, double atol) {
  scene.options.ode_solver_method = method;
  scene.options.rtol = rtol;
  scene.options.atol = atol;
  return scene;
}

}  // namespace

TEST_CASE("the exact answer of the ball is the published sum of its flights", "[laws][models]") {
  // t_k = t1 + 2 t1 (e + ... + e^(k-1)), and t1 (1 + e) / (1 - e) for k without end; to rounding of
  // times below 32 s.
  const double t1 = std::sqrt(2.0 * 10.0 / 9.81);
  const models::Ballistic ball({.e = 0.9, .y0 = 10.0}, 40.0);
  const EventSeries& series = ball.bounces().series.front();
  double t = t1, power = 1.0;
  for (std::size_t k = 0; k < 50; ++k) {
    CHECK_THAT(series.times[k], WithinAbs(t, 1e-13));
    t += 2.0 * t1 * (power *= 0.9);
  }
  CHECK_THAT(series.accumulation, WithinRel(t1 * 1.9 / 0.1, 1e-14));
  CHECK(ball.branch_at(2.0).events == 1);
  CHECK(ball.branch_at(30.0).rest);
}

TEST_CASE("the exact answer follows a floor that drops", "[laws][models]") {
  const models::Ballistic at_rest({.e = 0.8, .y0 = 1e-3, .dropped = -1e-3, .drop_time = 1.0}, 1.1);
  REQUIRE(at_rest.bounces().series.size() == 2);
  CHECK_THAT(at_rest.bounces().series[0].accumulation, WithinAbs(0.12850588106343583, 1e-16));
  CHECK(at_rest.bounces().series[0].release == 1.0);
  CHECK(at_rest.bounces().series[1].times.size() == 7);
  const models::Ballistic in_flight(
      {.e = 0.9, .y0 = 10.0, .floor = 5.0, .dropped = 0.0, .drop_time = 10.0}, 40.0);
  REQUIRE(in_flight.bounces().series.size() == 1);
  CHECK_THAT(in_flight.bounces().series[0].accumulation, WithinAbs(31.272333732171473, 4e-15));
  CHECK(std::ranges::upper_bound(in_flight.bounces().series[0].times, 10.0) -
            in_flight.bounces().series[0].times.begin() ==
        7);
}

TEST_CASE("the ball agrees with the closed form with every method", "[laws][models]") {
  const auto method = GENERATE(Method::dopri5, Method::adams, Method::bdf, Method::automatic);
  const double rtol = GENERATE(1e-6, 1e-10);
  INFO("method " << method << ", rtol " << rtol);
  const Scene scene = at_tolerance(models::bouncing_ball(), method, rtol, 1e-2 * rtol);
  const Achieved a = achieved(scene, simulate(scene));
  // Heights and speeds reach 14. A bounce passes an error in speed on with the factor 0.9, and
  // turns one of the height into one of time: nothing grows. Ten times what a step may do wrong is
  // the bound that every method is held to.
  const double allowed = 10.0 * (14.0 * rtol + 1e-2 * rtol);
  CHECK(a.error <= allowed);
  CHECK(a.event_error <= allowed);
  CHECK(a.event_mismatch == 0);
}

TEST_CASE("one-step methods are exact on parabolas, at any tolerance", "[laws][models]") {
  const double rtol = GENERATE(1e-2, 1e-5, 1e-12);
  const Scene scene = at_tolerance(models::bouncing_ball(), Method::dopri5, rtol, 1e-2 * rtol);
  const Achieved a = achieved(scene, simulate(scene));
  // 12 steps and 6 locations of 100 eps (t + h) each, t + h <= 24, at speeds up to 14 and an
  // acceleration of 10.
  CHECK(a.event_error <= 6 * 100 * 2.3e-16 * 24);
  CHECK(a.error <= 14 * 6 * 100 * 2.3e-16 * 24);
}

TEST_CASE("leaf and diagram are the same ball", "[laws][models]") {
  const auto method = GENERATE(Method::dopri5, Method::adams, Method::automatic);
  INFO("method " << method);
  // At 1e-12 each is within 10 (14e-12 + 1e-14) = 1.4e-10 of the truth by the bound above; two that
  // see the same equation with the same norm err alike.
  const Scene leaf = at_tolerance(models::bouncing_ball(), method, 1e-12, 1e-14);
  const Scene blocks = at_tolerance(
      models::bouncing_ball_diagram(
          {.e = 0.9, .y0 = 10.0, .floor = 0.0, .dropped = 0.0, .drop_time = 100.0, .t_end = 12.0}),
      method, 1e-12, 1e-14);
  const Results a = simulate(leaf), b = simulate(blocks);
  const auto bounces = a.events.times("ball.bounce"), resets = b.events.times("integrator_y.reset");
  REQUIRE(bounces.size() == 6);
  REQUIRE(resets.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK_THAT(resets[i], WithinAbs(bounces[i], 1e-10));
  const System& y = (*std::static_pointer_cast<const Diagram>(blocks.system))["integrator_y"];
  const System& v = (*std::static_pointer_cast<const Diagram>(blocks.system))["integrator_v"];
  CHECK_THAT(b.context[y.system_id()].continuous_state()[0],
             WithinAbs(a.context.continuous_state()[0], 1e-10));
  CHECK_THAT(b.context[v.system_id()].continuous_state()[0],
             WithinAbs(a.context.continuous_state()[1], 1e-10));
}

TEST_CASE("the tutorial's scenes are right to 1e-9 in time and height at its own tolerances",
          "[laws][models]") {
  const auto scenes = models::tutorial();
  const auto number = GENERATE(0U, 1U, 2U, 3U);
  const Scene& scene = scenes[number];
  INFO(scene.name);
  const Results results = simulate(scene);
  const Achieved a = achieved(scene, results);
  CHECK(results.status == Status::reached_end);
  CHECK(a.error <= 1e-9);
  CHECK(a.event_error <= 1e-9);
  CHECK(a.event_mismatch == 0);
  if (number >= 2) CHECK(a.accumulation_error <= 1e-9);
  if (number == 2) CHECK(a.release_error == 0.0);
}

TEST_CASE(
    "balls that start on the floor, or are thrown at it, follow the closed form into their rest",
    "[laws][models]") {
  const double e = GENERATE(0.0, 0.5, 1.0);
  const double v0 = GENERATE(0.0, 5.0, -5.0);
  INFO("e " << e << ", v0 " << v0);
  const Scene scene = models::bouncing_ball({.e = e, .y0 = 0.0, .v0 = v0, .t_end = 3.0});
  const Achieved a = achieved(scene, simulate(scene));
  // Parabolas again: some 20 locations of 100 eps (t + h) each, t + h <= 6, speeds up to 5.
  CHECK(a.error <= 5 * 20 * 100 * 2.3e-16 * 6);
  CHECK(a.event_mismatch == 0);
  if (e < 1.0 || v0 == 0.0) CHECK(a.accumulation_error <= 20 * 100 * 2.3e-16 * 6);
}

TEST_CASE("Robertson's reaction runs to 4e10 s", "[laws][models]") {
  const auto method = GENERATE(Method::bdf, Method::automatic);
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8);
  INFO("method " << method << ", rtol " << rtol);
  // y2 is below 1e-4 all the time and 1e-13 at the end: it has a say only with an atol that small.
  const Scene scene = at_tolerance(models::robertson(), method, rtol, 1e-14);
  const Results results = simulate(scene);
  REQUIRE(results.status == Status::reached_end);
  REQUIRE(results.time.size() >= 12);
  const Achieved a = achieved(scene, results);
  // The slow manifold attracts, but along it errors add up while y1 falls like 1/t: CVODE is held
  // to a hundred local errors over eleven decades, here of y1 relative to its size as well.
  CHECK(a.error <= 100 * rtol);
  CHECK(a.event_mismatch == 0);
  const auto crossing = results.events.times("y1_is_1e-4");
  REQUIRE(crossing.size() == 1);
  CHECK_THAT(crossing[0], WithinRel(20795496.883026623,
                                    100 * rtol));  // y1 ~ 1/t there: relative errors are equal
}

TEST_CASE("Van der Pol's oscillator with mu = 1000 looks stiff, and auto goes over to Radau",
          "[laws][models]") {
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8);
  INFO("rtol " << rtol);
  const Scene by_radau = at_tolerance(models::van_der_pol(), Method::radau, rtol, 1e-2 * rtol);
  const Scene by_auto = at_tolerance(models::van_der_pol(), Method::automatic, rtol, 1e-2 * rtol);
  const Results radau = simulate(by_radau), automatic = simulate(by_auto);
  CHECK(automatic.statistics.method.find("radau") != std::string::npos);
  // Before it is sure it takes a few hundred explicit steps of six calls.
  CHECK(automatic.statistics.right_hand_side_calls <=
        2 * radau.statistics.right_hand_side_calls + 1000);
  for (const Achieved& a : {achieved(by_radau, radau), achieved(by_auto, automatic)}) {
    CHECK(a.event_mismatch == 0);
    // Where it creeps, dx/dt is as small as 2/3 mu^-1: an error of x is one of time 1500 times as
    // large, and 0.9 mu^-1 times that, of x again, at the end. A hundred local errors of 2 rtol, as
    // above.
    CHECK(a.event_error <= 1500 * 100 * 2 * rtol);
    CHECK(a.error <= 100 * 2 * rtol);
  }
}

TEST_CASE("a mild Van der Pol oscillator is no stiff scene", "[laws][models]") {
  const Scene scene = models::van_der_pol({.mu = 1.0, .t_end = 20.0});
  CHECK(simulate(scene).statistics.method == "dopri5");
}

// --- the report
// -----------------------------------------------------------------------------------------------------

TEST_CASE("the report notices a bounce too few, and one in the wrong place", "[laws][report]") {
  Scene scene = models::bouncing_ball();
  const Results right = simulate(scene);
  scene.exact = models::ballistic_answer({.e = 0.5, .y0 = 10.0}, 12.0, "ball.bounce");
  const Achieved a = achieved(scene, right);
  CHECK(a.event_mismatch > 0);
  CHECK(a.event_error > 0.1);
  CHECK(a.error > 0.1);
}

TEST_CASE("rows at an event are compared on their own side", "[laws][report]") {
  // Both rows of a bounce have the same time; on the wrong side the velocity would be off by twice
  // its size.
  const Scene scene = at_tolerance(models::bouncing_ball(), Method::adams, 1e-6, 1e-8);
  const Achieved a = achieved(scene, simulate(scene));
  CHECK(a.error < 1e-3);
}
