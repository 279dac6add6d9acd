// Semantics 5.1, 5.3, 5.4: rows, events and counts of a run with bounces.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("5.1 one row for each accepted step, and one more after each pass", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.8})) {
    INFO(scene.form << ", method " << method);
    const auto results =
        simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 3.0},
                 {.ode_solver_method = method, .recorded_signals = {{"y", scene.height}}});
    const auto passes = static_cast<std::size_t>(results.jump.back());
    const auto steps = static_cast<std::size_t>(results.statistics.steps);
    CHECK(passes >= 6);
    CHECK(results.time.size() == 1 + steps + passes);
    CHECK(results.time.front() == 0.0);
    CHECK(results.time.back() == 3.0);
  }
}

TEST_CASE("5.3 the event log is complete though nothing is recorded", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const BallScene scene = leaf({.e = 1.0});
  const auto results =
      simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 10.0}, {.ode_solver_method = method});
  CHECK(results.time.empty());
  CHECK(results.events.times("bounce").size() == 11);  // t1 = 0.4515 s, then every 0.903 s
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const Event event = results.events[i];
    CHECK(event.direction == -1);
    CHECK(event.jump == static_cast<int>(i) + 1);
    CHECK(event.after[1] == -event.before[1]);
  }
}

TEST_CASE("5.3 a release and a time event are in the log with their kind", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const BallScene scene = leaf_on(
      {}, std::make_shared<Step>("floor", Step::Options{.end_value = -1.0, .step_time = 1.0}));
  const auto results =
      simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 1.1}, {.ode_solver_method = method});
  CHECK(count(results.events, EventKind::zeno_enter, "bounce") == 1);
  CHECK(count(results.events, EventKind::time) == 1);
  CHECK(count(results.events, EventKind::zeno_release, "bounce") == 1);
}

TEST_CASE("5.4 statistics are summed across restarts", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  std::int64_t odes = 0, guards = 0;
  const Leaf ball("ball", [&](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0, 0.0}), .ode = [&](const At& at, VectorRef f) {
                                  ++odes;
                                  f << at.x[1], -9.81;
                                }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [&](const At& at) { return ++guards, at.x[0]; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state({0.0, -at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
  const auto results =
      simulate(ball, ball.create_context(), {0.0, 10.0}, {.ode_solver_method = method});
  const Statistics& s = results.statistics;
  CHECK(s.right_hand_side_calls == odes);
  CHECK(s.guard_calls == guards);
  CHECK(s.restarts == 11);
  CHECK(s.events == 11);
  CHECK(s.steps >= 12);  // one for each flight at least
  CHECK(s.rejected >= 0);
  CHECK(s.wall_time > 0.0);
  CHECK(s.events_by_name == std::vector<std::pair<std::string, std::int64_t>>{{"ball.bounce", 11}});
  const auto half =
      simulate(ball, ball.create_context(), {0.0, 5.0}, {.ode_solver_method = method}).statistics;
  CHECK(half.steps < s.steps);
  CHECK(half.restarts == 6);
}

TEST_CASE("5.1 a guard that only ends the run leaves one row and is no jump", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "end", .guard = [](const At& at) { return at.x[0] - 0.5; }, .terminal = true});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0},
               {.ode_solver_method = method, .recorded_signals = {{"x", leaf.output()}}});
  REQUIRE(results.events.size() == 1);
  CHECK(std::ranges::count(results.time, results.events[0].time) == 1);
  CHECK(results.events[0].jump == 0);
  CHECK(results.jump.back() == 0);
}

TEST_CASE("5.1 in the row before a pass a trigger that fired is true, in the one after it false",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const BallScene scene = blocks(GENERATE(from_range(contacts)), {.e = 0.8});
  INFO(scene.form << ", method " << method);
  const System& touches = dynamic_cast<const Diagram&>(*scene.system)["touches"];
  const auto results =
      simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 3.0},
               {.ode_solver_method = method, .recorded_signals = {{"touches", touches.output()}}});
  const std::vector<double>& touched = results.signals[0].values;
  REQUIRE(results.jump.back() >= 4);
  CHECK(std::ranges::count(touched, 1.0) == results.jump.back());
  for (std::size_t i = 0; i + 1 < touched.size(); ++i)
    CHECK((touched[i] == 1.0) == (results.jump[i] < results.jump[i + 1]));
}
