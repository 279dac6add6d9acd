// Semantics 4.5: a floor that moves continuously carries a ball at rest, or falls away under it.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 10.0;

std::shared_ptr<const System> ramp(double slope) {
  return std::make_shared<Ramp>("floor", Ramp::Options{.slope = slope, .start_time = 1.0});
}

std::vector<double> releases(const Results& results) {
  std::vector<double> times;
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].kind == EventKind::zeno_release) times.push_back(results.events[i].time);
  }
  return times;
}

}  // namespace

TEST_CASE("4.5 a floor that rises continuously under a resting ball carries it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms_over({.g = g, .e = 0.5}, [] { return ramp(0.5); })) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 3.0},
                                  {.ode_solver_method = method, .throw_errors = false});
    CHECK(results.status == Status::reached_end);
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(1.0, 1e-6));
    CHECK(results.statistics.events < 1000);  // 4.6: no guard storm
  }
}

TEST_CASE("4.5 a floor that begins to fall lets a resting ball go exactly then", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  // At 1 s the floor leaves with 1 m/s; the ball catches up after 2 / g = 0.2 s and bounces.
  const std::vector<BallScene> scenes{leaf_on({.g = g, .e = 0.5}, ramp(-1.0)),
                                      blocks(Contact::comparator, {.g = g, .e = 0.5}, ramp(-1.0))};
  for (const BallScene& scene : scenes) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 1.19},
                                  {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
    const auto found = releases(results);
    REQUIRE(found.size() == static_cast<std::size_t>(scene.monitors));
    for (const double t : found) CHECK(t == 1.0);
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(-0.5 * g * 0.19 * 0.19, 1e-6));
  }
}

TEST_CASE("4.5 a floor that begins to fall lets go of a ball whose contact is opaque",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto contact = GENERATE(Contact::reduce, Contact::function);
  const BallScene scene = blocks(contact, {.g = g, .e = 0.5}, ramp(-1.0));
  INFO(scene.form << ", method " << method);
  const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 1.19},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  // A boolean is seen to fall when the floor has moved by more than rounding.
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(-0.5 * g * 0.19 * 0.19, 1e-5));
}

TEST_CASE("4.5 a ball let go by a floor lands on it again, bounces and rests", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const BallScene scene =
      leaf_on({.g = g, .e = 0.5},
              std::make_shared<Step>("floor", Step::Options{.end_value = -0.2, .step_time = 1.0}));
  INFO("method " << method);
  const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 3.0},
                                {.rtol = 1e-10, .atol = 1e-13, .ode_solver_method = method});
  CHECK(count(results.events, EventKind::zeno_enter) == 2);
  CHECK(count(results.events, EventKind::zeno_release) == 1);
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(-0.2, 1e-9));
}
