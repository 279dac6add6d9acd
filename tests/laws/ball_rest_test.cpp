// Past its Zeno time a ball is at rest on the floor; the accumulation time is predicted.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 9.81;

/// Below this speed flights last less than the Zeno tolerance, or rise less than atol can see.
double least_speed(double zeno_tolerance, double atol) {
  return std::max(0.5 * g * zeno_tolerance, std::sqrt(2.0 * g * 1e4 * atol));
}

void comes_to_rest(const BallScene& scene, Method method, double e, double y0, double end) {
  INFO(scene.form << ", method " << method << ", e = " << e);
  const double atol = 1e-10;
  const auto results =
      simulate(*scene.system, scene.context(y0, 0.0), {0.0, end},
               {.rtol = 1e-8, .atol = atol, .ode_solver_method = method, .throw_errors = false});
  CHECK(results.status == Status::reached_end);
  CHECK(results.message == "");
  CHECK(count(results.events, EventKind::zeno_enter) == scene.monitors);
  const auto& x = results.context.continuous_state();
  // Held at the accumulation state, or where the flight could no longer be seen: heights of atol's
  // size.
  CHECK_THAT(x[0], WithinAbs(0.0, 1e4 * atol));
  CHECK_THAT(x[1], WithinAbs(0.0, least_speed(1e-6, atol)));
}

}  // namespace

TEST_CASE("a ball of any restitution ends at rest on the floor, by any method",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.1, 0.5, 0.9);
  for (const BallScene& scene : all_forms({.g = g, .e = e})) {
    comes_to_rest(scene, method, e, 1.0, 1.5 * BallExact{g, e, 1.0}.rest() + 0.1);
  }
}

TEST_CASE("a ball of restitution 0.999 ends at rest after thousands of bounces",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double y0 = 1e-3;
  comes_to_rest(leaf({.g = g, .e = 0.999}), method, 0.999, y0,
                1.2 * BallExact{g, 0.999, y0}.rest());
}

TEST_CASE("the accumulation time is predicted from the gaps before", "[laws][ball][zeno]") {
  const double e = GENERATE(0.3, 0.5, 0.8, 0.9);
  const BallExact exact{g, e, 1e-3};
  for (const BallScene& scene : all_forms({.g = g, .e = e})) {
    INFO(scene.form << ", e = " << e);
    const auto results =
        simulate(*scene.system, scene.context(1e-3, 0.0), {0.0, 1.0},
                 {.rtol = 1e-10, .atol = 1e-14, .ode_solver_method = Method::dopri5});
    REQUIRE(count(results.events, EventKind::zeno_enter) == scene.monitors);
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      if (results.events[i].kind == EventKind::zeno_enter)
        CHECK_THAT(results.events[i].predicted, WithinAbs(exact.rest(), 1e-9));
    }
    const auto& x = results.context.continuous_state();
    CHECK_THAT(x[0], WithinAbs(0.0, 1e-9));
    CHECK_THAT(x[1], WithinAbs(0.0, 1e-9));
  }
}

TEST_CASE("a ball placed at rest on the floor rests there", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double floor = GENERATE(0.0, 5.0, -3.0, 0.1);
  for (const BallScene& scene : all_forms({.g = g, .floor = floor})) {
    INFO(scene.form << ", method " << method << ", floor " << floor);
    const auto results = simulate(*scene.system, scene.context(floor, 0.0), {0.0, 3.0},
                                  {.ode_solver_method = method});
    CHECK(count(results.events, EventKind::zeno_enter) == scene.monitors);
    CHECK(results.context.continuous_state()[0] == floor);
    // An opaque boolean is seen to change when the height does: one rounding of the floor below it,
    // or atol = 1e-8 m.
    const bool opaque = scene.form == "ReduceBlock" || scene.form == "FunctionBlock";
    const double seen = opaque ? std::sqrt(2.0 * g * 2.0 * eps * std::abs(floor)) + 1e-8 : 0.0;
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(0.0, seen));
  }
}
