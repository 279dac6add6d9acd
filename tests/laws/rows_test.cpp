// Rows: before and after each pass that changed something, at steps or asked-for times, at start
// and end; none twice.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

void rows_are_sound(const Results& results, double begin, double end) {
  REQUIRE(results.time.size() == results.jump.size());
  REQUIRE(!results.time.empty());
  CHECK(results.time.front() == begin);
  CHECK(results.time.back() == end);
  for (std::size_t i = 1; i < results.time.size(); ++i) {
    CHECK(results.time[i] >= results.time[i - 1]);
    CHECK(results.jump[i] >= results.jump[i - 1]);
    CHECK((results.time[i] > results.time[i - 1] || results.jump[i] > results.jump[i - 1]));
  }
  // Each jump: the row before it and the row after it at its time.
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const Event event = results.events[i];
    if (event.jump == 0) continue;
    const auto rows = rows_at(results, event.time);
    REQUIRE(rows.size() >= 2);
    const auto has = [&](int jump) {
      return std::ranges::count_if(rows,
                                   [&](std::size_t row) { return results.jump[row] == jump; });
    };
    CHECK(has(event.jump - 1) == 1);
    CHECK(has(event.jump) == 1);
  }
}

}  // namespace

TEST_CASE("time never decreases and no row stands twice, whatever is recorded", "[laws][rows]") {
  const auto method = GENERATE(from_range(methods));
  const auto drop = [] {
    return std::make_shared<Step>("floor", Step::Options{.end_value = -0.5, .step_time = 3.0});
  };
  for (const BallScene& scene : all_forms_over({.e = 0.6}, drop)) {
    INFO(scene.form << ", method " << method);
    for (const std::vector<double>& times :
         {std::vector<double>{}, {0.0, 0.5, 1.0, 3.0, 4.0}, {0.25}}) {
      for (const std::optional<bool> steps :
           {std::optional<bool>(), std::optional(true), std::optional(false)}) {
        const auto results = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 4.0},
                                      {.ode_solver_method = method,
                                       .recorded_signals = {{"y", scene.height}},
                                       .save_at = times,
                                       .save_steps = steps});
        rows_are_sound(results, 0.0, 4.0);
        for (const double t : times) CHECK(!rows_at(results, t).empty());
      }
    }
  }
}

TEST_CASE("rows at asked-for times are right, whatever the steps are", "[laws][rows]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_continuous_state_output("x");
    l.declare_output_port({.name = "twice", .calc = [](const At& at) { return 2.0 * at.x[0]; }});
  });
  std::vector<double> times;
  for (int i = 0; i <= 100; ++i) times.push_back(0.1 * i);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 10.0},
               {.rtol = 1e-9,
                .atol = 1e-11,
                .ode_solver_method = method,
                .recorded_signals = {{"x", leaf.output(0)}, {"twice", leaf.output(1)}},
                .save_at = times});
  REQUIRE(results.time == times);
  const auto x = results.output("x");
  const auto twice = results.output("twice");
  CHECK(x.cols() == 2);
  // Tolerance 1e-9, ten radians, interpolants up to two powers of ten worse than the steps.
  for (Index i = 0; i < x.rows(); ++i) {
    const double t = times[static_cast<std::size_t>(i)];
    CHECK_THAT(x(i, 0), WithinAbs(std::sin(t), 1e-6));
    CHECK_THAT(twice(i, 0), WithinAbs(2.0 * std::sin(t), 2e-6));
  }
}

TEST_CASE("the row before a bounce shows the ball falling, the row after it rising",
          "[laws][rows]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const BallScene scene = leaf({.e = 0.5});
  const auto results =
      simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 0.6},
               {.ode_solver_method = method, .recorded_signals = {{"y", scene.height}}});
  const auto rows = rows_at(results, results.events[0].time);
  REQUIRE(rows.size() == 2);
  const auto y = results.output("y");
  const double v = y(static_cast<Index>(rows[0]), 1);
  CHECK(v < 0.0);
  CHECK(y(static_cast<Index>(rows[0]), 0) <= 0.0);
  CHECK(y(static_cast<Index>(rows[1]), 1) == -0.5 * v);
  CHECK(y(static_cast<Index>(rows[1]), 0) == 0.0);
}

TEST_CASE("a run of zero length has the rows of its start", "[laws][rows]") {
  const BallScene scene = leaf({.e = 0.5});
  const auto results = simulate(*scene.system, scene.context(1.0, 0.0, 3.0), {3.0, 3.0},
                                {.recorded_signals = {{"y", scene.height}}});
  CHECK(results.time == std::vector{3.0});
  CHECK(results.status == Status::reached_end);
  CHECK(same_bits(results.context, scene.context(1.0, 0.0, 3.0)));
  CHECK(results.statistics.steps == 0);
}

TEST_CASE("no state, no guard, no output: a legal scene, and time passes", "[laws][rows]") {
  const Leaf nothing("nothing", [](Leaf&) {});
  const auto results = simulate(nothing, nothing.create_context(), {0.0, 1e6});
  CHECK(results.context.time() == 1e6);
  CHECK(results.status == Status::reached_end);
  CHECK(results.time.empty());
  CHECK(results.events.empty());
  CHECK(results.statistics.steps == 0);
}

TEST_CASE("without continuous state rows stand at events and asked-for times", "[laws][rows]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("count");
    l.declare_periodic_update(count_up, 1.0, 0.5);
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 3.0},
               {.recorded_signals = {{"n", leaf.output()}}, .save_at = {1.0, 2.0}});
  CHECK(results.time == std::vector{0.0, 0.5, 0.5, 1.0, 1.5, 1.5, 2.0, 2.5, 2.5, 3.0});
  CHECK(column(results, "n") == std::vector{0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0});
}
