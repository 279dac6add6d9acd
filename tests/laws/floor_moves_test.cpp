// A floor that drops lets a resting ball go at exactly that time; one that rises carries it.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 9.81;

std::shared_ptr<const System> step(double before, double after, double at) {
  return std::make_shared<Step>(
      "floor", Step::Options{.start_value = before, .end_value = after, .step_time = at});
}

std::vector<double> releases(const Results& results) {
  std::vector<double> times;
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].kind == EventKind::zeno_release) times.push_back(results.events[i].time);
  }
  return times;
}

}  // namespace

TEST_CASE("a floor that drops under a resting ball lets it go exactly then", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double drop = GENERATE(1.0, 1.0 / 3.0);
  for (const BallScene& scene :
       all_forms_over({.g = g, .e = 0.5}, [&] { return step(0.0, -2.0, drop); })) {
    INFO(scene.form << ", method " << method << ", drop at " << drop);
    const double rtol = 1e-9, atol = 1e-11;
    const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, drop + 0.5},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    const auto times = releases(results);
    REQUIRE(times.size() == static_cast<std::size_t>(scene.monitors));
    for (const double t : times) CHECK(t == drop);
    // It falls from rest for half a second, 1.2 m of the 2 m.
    const double tolerance = 100.0 * (rtol * 5.0 + atol) + 1e-7 * (scene.form != "leaf with floor");
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(-0.5 * g * 0.25, tolerance));
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(-0.5 * g, tolerance));
  }
}

TEST_CASE("the tutorial's third scene: to rest, let go at 1 s, seven bounces by 1.1 s",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double e = 0.8, y0 = 1e-3;
  const BallExact exact{g, e, y0};
  for (const BallScene& scene :
       all_forms_over({.g = g, .e = e}, [&] { return step(0.0, -y0, 1.0); })) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(y0, 0.0), {0.0, 1.1},
                                  {.rtol = 1e-10, .atol = 1e-13, .ode_solver_method = method});
    std::vector<double> times;
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      const Event event = results.events[i];
      if (event.time > 1.0 && (event.name == "bounce" || event.block == "integrator_y"))
        times.push_back(event.time);
    }
    REQUIRE(times.size() == 7);
    // The ball leaves rest with y = v = 0 to 1e-9: contact k moves by 1e-9 (1 + 2
    // k) / (g t1) at most.
    for (int k = 1; k <= 7; ++k) {
      CHECK_THAT(times[static_cast<std::size_t>(k - 1)], WithinAbs(1.0 + exact.contact(k), 1e-7));
    }
    CHECK(count(results.events, EventKind::zeno_enter) == scene.monitors);
  }
}

TEST_CASE("a floor that steps up under a resting ball carries it", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene :
       all_forms_over({.g = g, .e = 0.5}, [&] { return step(0.0, 0.75, 1.0); })) {
    INFO(scene.form << ", method " << method);
    const auto results =
        simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 2.0}, {.ode_solver_method = method});
    CHECK(results.context.continuous_state()[0] == 0.75);
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(0.0, 1e-7));
    // An opaque boolean y < floor is false on the floor: it lets go and catches again, one rounding
    // lower.
    if (scene.form == "leaf with floor" || scene.form == "Comparator")
      CHECK(releases(results).empty());
  }
}

TEST_CASE("a floor that steps up past a flying ball takes it along", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene :
       all_forms_over({.g = g, .e = 0.5}, [&] { return step(0.0, 3.0, 0.1); })) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 0.12},
                                  {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
    // The step is a commit that moves the guard across zero: the ball is put on the floor, its
    // velocity turned.
    const double v = 0.5 * g * 0.1;
    CHECK_THAT(results.context.continuous_state()[0],
               WithinAbs(3.0 + v * 0.02 - 0.5 * g * 4e-4, 1e-6));
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(v - g * 0.02, 1e-6));
  }
}

TEST_CASE("a ball that a floor took along bounces on it and comes to rest there",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene :
       all_forms_over({.g = g, .e = 0.5}, [&] { return step(0.0, 3.0, 0.1); })) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 0.4},
                                  {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
    // Up with 0.49 m/s at 0.1 s: flights of 0.1, 0.05, ... s, at rest at 0.3 s.
    const BallExact exact{g, 0.5, 0.5 * g * 0.01};
    std::vector<double> times;
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      const Event event = results.events[i];
      if (event.kind == EventKind::zero_crossing &&
          (event.name == "bounce" || event.block == "integrator_y"))
        times.push_back(event.time);
    }
    REQUIRE(times.size() > 5);
    for (int k = 1; k <= 5; ++k) {
      CHECK_THAT(times[static_cast<std::size_t>(k - 1)], WithinAbs(exact.contact(k), 1e-6));
    }
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(3.0, 1e-8));
    CHECK(count(results.events, EventKind::zeno_enter) == scene.monitors);
  }
}

TEST_CASE("of two balls in one diagram one rests while the other bounces", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& first = builder.add<Ball>(BallOptions{.g = g, .e = 0.0}, "first");
  auto& second = builder.add<Ball>(BallOptions{.g = g, .e = 1.0}, "second");
  const Diagram diagram = builder.build();
  auto context = diagram.create_context();
  context = context.with_subcontext(
      first.system_id(), context[first.system_id()].with_continuous_state(vec({0.5, 0.0})));
  context = context.with_subcontext(
      second.system_id(), context[second.system_id()].with_continuous_state(vec({2.0, 0.0})));
  const double rtol = 1e-9, atol = 1e-11;
  const auto results = simulate(diagram, context, {0.0, 20.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  CHECK(results.context.continuous_state()[0] == 0.0);
  CHECK(results.context.continuous_state()[1] == 0.0);
  const auto bounces = results.events.times("second.bounce");
  const BallExact exact{g, 1.0, 2.0};
  REQUIRE(bounces.size() == 16);  // t1 = 0.6386 s, then every 1.2771 s
  for (int k = 1; k <= 16; ++k) {
    CHECK_THAT(bounces[static_cast<std::size_t>(k - 1)],
               WithinAbs(exact.contact(k), 16.0 * 16.0 * 20.0 * (rtol * 7.0 + atol) / g));
  }
}
