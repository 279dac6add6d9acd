// Dense output: what a run says between its rows.
#include <numbers>

#include "support/balls.hpp"
#include "support/circle.hpp"
#include "support/convergence.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// Error of the dense output inside steps of length h from exact values on.
double error_of_steps(Method method, double h) {
  const auto results = run_circle({.rtol = 1e6,
                                   .atol = 1e6,
                                   .ode_solver_method = method,
                                   .max_minor_step_size = h,
                                   .dense_output = true},
                                  2.0);
  double worst = 0.0;
  for (const double t : inner_times(0.5, 2.0, 301))
    worst = std::max(worst, std::abs(results.at(t).continuous_state[0] - std::cos(t)));
  return worst;
}

}  // namespace

TEST_CASE("dense output keeps the order of the method", "[dense][order]") {
  // Inside a step the error is that of the interpolant, h^(degree + 1), as far as that of the steps
  // at their ends, h^5 and h^8 summed over 1/h of them, allows: 5 and 8, less what is observed at
  // finite h.
  const double dopri5 =
      order(error_of_steps(Method::dopri5, 0.2), error_of_steps(Method::dopri5, 0.1));
  const double dop853 =
      order(error_of_steps(Method::dop853, 0.5), error_of_steps(Method::dop853, 0.25));
  CHECK(dopri5 > 4.6);
  CHECK(dopri5 < 5.6);
  CHECK(dop853 > 7.4);
  CHECK(dop853 < 9.0);
}

TEST_CASE("a ball between bounces, at them and at rest, against the closed form", "[dense]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::automatic);
  INFO("method " << method);
  const Ball ball({.g = 10.0, .e = 0.5});
  const auto results = simulate(ball, ball.create_context().with_continuous_state({5.0, 0.0}),
                                {0.0, 4.0}, {.ode_solver_method = method, .dense_output = true});
  // One second down, one up and down again at half the speed, and so on: rest from 3 s on.
  CHECK_THAT(results.at(0.5).continuous_state[0], WithinAbs(3.75, 1e-13));
  CHECK_THAT(results.at(1.5).continuous_state[0], WithinAbs(1.25, 1e-13));
  const double bounce = results.events[0].time;
  CHECK_THAT(results.at(bounce, Side::left).continuous_state[1], WithinAbs(-10.0, 1e-12));
  CHECK_THAT(results.at(bounce).continuous_state[1], WithinAbs(5.0, 1e-12));
  CHECK(results.at(bounce).continuous_state[1] == results.events[0].after[1]);
  CHECK(results.at(bounce, Side::left).continuous_state[1] == results.events[0].before[1]);
  const Eigen::VectorXd rest = results.at(3.5).continuous_state;
  for (const double t : inner_times(3.01, 4.0, 50)) CHECK(results.at(t).continuous_state == rest);
  CHECK(results.at(4.0).continuous_state == results.context.continuous_state());
  CHECK(results.at(0.0, Side::left).continuous_state == vec({5.0, 0.0}));
}

TEST_CASE("dense output rides on a surface that moves", "[dense]") {
  const auto method = GENERATE(from_range(methods));
  struct Ride {
    BallScene scene;
    double (*floor)(double);
  };
  const BallOptions ball{.g = 10.0, .e = 0.5};
  const Ride rides[]{
      {leaf_on(ball, std::make_shared<Sine>("floor", Sine::Options{.amplitude = 0.1,
                                                                   .phase = -0.5 * std::numbers::pi,
                                                                   .bias = 0.1})),
       [](double t) { return 0.1 - 0.1 * std::cos(t); }},
      {blocks(Contact::comparator, ball,
              std::make_shared<Ramp>("floor", Ramp::Options{.slope = 0.5, .start_time = 1.0})),
       [](double t) { return 0.5 * (t - 1.0); }}};
  for (const auto& [scene, floor_at] : rides) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 3.0},
                                  {.rtol = 1e-8,
                                   .atol = 1e-10,
                                   .ode_solver_method = method,
                                   .dense_output = true,
                                   .throw_errors = false});
    REQUIRE(results.status == Status::reached_end);
    // At rest on it the ball is where the floor is: its reset map says so at every time. (From pi s
    // on the sine sinks under a ball whose reset map leaves it no speed.)
    for (const double t : inner_times(1.5, 3.0, 40))
      CHECK_THAT(results.at(t).continuous_state[0], WithinAbs(floor_at(t), 1e-12));
  }
}

TEST_CASE("a scene without continuous state has dense output too", "[dense]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.5);
  builder.connect(sine.output(), hold.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 2.0},
               {.recorded_signals = {{"sine", sine.output()}, {"hold", hold.output()}},
                .dense_output = true});
  CHECK(results.at(0.7).output("sine")[0] == std::sin(0.7));
  CHECK(results.at(0.7).output("hold")[0] == std::sin(0.5));
  CHECK(results.at(0.5, Side::left).output("hold")[0] == 0.0);
}

TEST_CASE("a run in pieces is one trajectory, one taken out begins another", "[dense]") {
  const Ball ball({.g = 10.0, .e = 0.5});
  Simulator simulator(ball, {.dense_output = true});
  simulator.initialize(ball.create_context().with_continuous_state({5.0, 0.0}));
  CHECK(simulator.results().trajectory.empty());
  for (const double t : {0.25, 0.75, 0.75, 1.5}) simulator.advance_to(t);
  CHECK_THAT(simulator.results().at(0.5).continuous_state[0], WithinAbs(3.75, 1e-13));
  CHECK_THAT(simulator.results().at(0.75, Side::left).continuous_state[0],
             WithinAbs(5.0 - 5.0 * 0.75 * 0.75, 1e-13));
  const Results taken = simulator.take_results();
  simulator.advance_to(2.0);
  CHECK(taken.trajectory.end() == 1.5);
  CHECK(simulator.results().trajectory.begin() == 1.5);
  CHECK_THAT(simulator.results().at(1.75).continuous_state[0],
             WithinAbs(5.0 * 0.75 - 5.0 * 0.75 * 0.75, 1e-12));
}

TEST_CASE("a failed run can be read up to where it failed", "[dense][errors]") {
  const auto leaf = make_leaf("fails", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "wall",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .reset_map = [](const At&, Next&) { throw Error("no"); }});
  });
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, 2.0},
                                {.dense_output = true, .throw_errors = false});
  REQUIRE(results.status == Status::failed);
  CHECK_THAT(results.trajectory.end(), WithinAbs(1.0, 1e-12));
  CHECK_THAT(results.at(0.4).continuous_state[0], WithinAbs(0.4, 1e-14));
  CHECK_THAT(results.at(results.trajectory.end()).continuous_state[0], WithinAbs(1.0, 1e-12));
}

TEST_CASE("event_rows = false records at save_at only, after the event at its time", "[rows]") {
  const auto leaf = make_leaf("steps", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("z");
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0}); }, 0.5);
  });
  const SimulatorOptions options{
      .recorded_signals = {{"x", leaf->output(0)}, {"z", leaf->output(1)}},
      .save_at = {0.0, 0.25, 1.0, 1.1, 2.0},
      .event_rows = false};
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, 2.0}, options);
  CHECK(results.time == options.save_at);
  CHECK(column(results, "z") == std::vector<double>{1.0, 1.0, 3.0, 3.0, 5.0});
  CHECK(worst(column(results, "x"), options.save_at) < 1e-14);
  CHECK(contains(message<ModelError>([&] { Simulator(*leaf, {.event_rows = false}); }), "save_at"));
}
