// SecondOrderIntegrator: parabolas between limits, stops, rebounds, and the release.
#include <cmath>

#include "library_runs.hpp"
#include "saltus/library/second_order_integrator.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

using Options = SecondOrderIntegrator::Options;

TEST_CASE("without limits position and velocity are the integrals", "[library][state]") {
  const BlockRun<SecondOrderIntegrator> scene(
      fed_by<Constant>(Value{2.0, 0.0}),
      Options{.initial_position = {1.0, 0.0}, .initial_velocity = Value{-1.0, 3.0}});
  CHECK_THAT(scene.at({2.0}, 0)[0], WithinAbs(1.0 - 2.0 + 4.0, rounding));
  CHECK_THAT(scene.at({2.0}, 1)[0], WithinAbs(3.0, rounding));
  CHECK_THAT(at_times(scene.diagram, scene.block->output(0), {2.0}, 1)[0],
             WithinAbs(6.0, rounding));
  CHECK(scene.block->output_names() == std::vector<std::string>{"x", "dx"});
}

/// Pushed by 1 the body reaches 0.5 at t = 1 and stays; from t = 3 it is pushed by -1 and leaves.
TEST_CASE("a body stops at its limit and leaves it when it is pushed inward", "[library][state]") {
  const BlockRun<SecondOrderIntegrator> scene(
      fed_by<Step>(Step::Options{.start_value = 1.0, .end_value = -1.0, .step_time = 3.0}),
      Options{.lower_limit = -10.0, .upper_limit = 0.5});
  const Numbers x = scene.at({0.5, 2.0, 4.0}), v = scene.at({0.5, 2.0, 4.0}, 1);
  const Numbers exact_x{0.125, 0.5, 0.0}, exact_v{0.5, 0.0, -1.0};
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK_THAT(x[i], WithinAbs(exact_x[i], rounding));
    CHECK_THAT(v[i], WithinAbs(exact_v[i], rounding));
  }
}

/// Dropped from 1 with g = 2: it reaches the floor at 1 with the speed 2, and rebounds with 1.
TEST_CASE("with a restitution the body rebounds, and comes to rest in the end",
          "[library][state]") {
  const BlockRun<SecondOrderIntegrator> scene(
      fed_by<Constant>(-2.0),
      Options{.initial_position = 1.0, .lower_limit = 0.0, .restitution = 0.5});
  CHECK_THAT(scene.at({1.25})[0], WithinAbs(0.25 - 0.0625, rounding));
  // The rebounds end at 1 + 2 (1/2 + 1/4 + ...) = 3.
  CHECK_THAT(scene.at({4.0})[0], WithinAbs(0.0, solver_tolerance));
  CHECK_THAT(scene.at({4.0}, 1)[0], WithinAbs(0.0, solver_tolerance));
}

TEST_CASE("each entry stops by itself", "[library][state]") {
  const BlockRun<SecondOrderIntegrator> scene(
      fed_by<Constant>(Value{2.0, -2.0}),
      Options{.initial_position = {0.0, 0.0}, .upper_limit = Value{1.0, 5.0}});
  const auto results = scene.run(3.0);
  const Eigen::VectorXd x = results.context.continuous_state();
  CHECK_THAT((x - Eigen::Vector4d(1.0, -9.0, 0.0, -6.0)).norm(), WithinAbs(0.0, rounding));
}

TEST_CASE("options of a SecondOrderIntegrator that do not fit are refused", "[library][state]") {
  const auto made = [](const Options& options) {
    return model_error([&] { SecondOrderIntegrator("s", options); });
  };
  CHECK(contains(made({.initial_position = 2.0, .upper_limit = 1.0}),
                 "initial_position 2 is outside the limits"));
  CHECK(contains(made({.lower_limit = 1.0, .upper_limit = -1.0}), "above upper_limit"));
  CHECK(contains(made({.initial_velocity = Value{1.0, 2.0}}), "initial_velocity has 2 values"));
  CHECK(contains(made({.restitution = 2.0}), "restitution = 2; expected 0 to 1"));
}

/// Pushed by 2 from rest: v = 2 t until 3, at 1.5 s, where x = 2.25; then x = 2.25 + 3 (t - 1.5). From
/// t = 3 pushed by -1, it leaves the limit: v = 3 - (t - 3).
TEST_CASE("a velocity stops at its limit and leaves it when it is pushed back",
          "[library][state]") {
  const BlockRun<SecondOrderIntegrator> scene(
      fed_by<Step>(Step::Options{.start_value = 2.0, .end_value = -1.0, .step_time = 3.0}),
      Options{.lower_velocity_limit = -1.0, .upper_velocity_limit = 3.0});
  const Numbers x = scene.at({1.0, 3.0, 4.0}), v = scene.at({1.0, 3.0, 4.0, 20.0}, 1);
  const Numbers exact_x{1.0, 6.75, 9.25}, exact_v{2.0, 3.0, 2.0, -1.0};
  for (std::size_t i = 0; i < x.size(); ++i) CHECK_THAT(x[i], WithinAbs(exact_x[i], rounding));
  for (std::size_t i = 0; i < v.size(); ++i) CHECK_THAT(v[i], WithinAbs(exact_v[i], rounding));
}

/// The trap: a rebound at -2 e would leave the velocity beyond its lower limit for good.
TEST_CASE("a rebound is within the limits of the velocity", "[library][state]") {
  const BlockRun<SecondOrderIntegrator> scene(fed_by<Constant>(0.0),
                                              Options{.initial_velocity = 2.0,
                                                      .upper_limit = 1.0,
                                                      .restitution = 1.0,
                                                      .lower_velocity_limit = -0.5});
  CHECK_THAT(scene.at({1.5}, 1)[0], WithinAbs(-0.5, rounding));
  CHECK_THAT(scene.at({1.5})[0], WithinAbs(0.5, rounding));
}

TEST_CASE("limits of the velocity are refused where they do not fit", "[library][errors]") {
  const auto refused = [](const Options& options) {
    return model_error([&] { SecondOrderIntegrator("s", options); });
  };
  CHECK(contains(refused({.initial_velocity = 2.0, .upper_velocity_limit = 1.0}),
                 "initial_velocity 2 is outside the limits"));
  CHECK(contains(refused({.lower_velocity_limit = Value{1.0, 2.0}}),
                 "lower_velocity_limit has 2 values"));
}

/// Where a context or a parameter puts a body beyond a limit, no flow would bring it back.
TEST_CASE("a run does not begin beyond a limit, and goes on from each end of a run",
          "[library][errors]") {
  const BlockRun<SecondOrderIntegrator> scene(fed_by<Constant>(1.0),
                                              Options{.lower_limit = -3.0,
                                                      .upper_limit = 0.5,
                                                      .lower_velocity_limit = 0.0,
                                                      .upper_velocity_limit = 0.75});
  const Context begin = scene.diagram.create_context();
  const auto refused = [&](const Context& context) {
    return model_error([&] { simulate(scene.diagram, context, {0.0, 1.0}); });
  };
  const auto at = [&](double x, double v) {
    return begin.with_continuous_state(Eigen::Vector2d(x, v));
  };
  CHECK(contains(refused(at(2.0, 0.0)), "x[0] = 2 is above upper_limit 0.5"));
  CHECK(contains(refused(at(-4.0, 0.0)), "x[0] = -4 is below lower_limit -3"));
  CHECK(contains(refused(at(0.0, 1.0)), "dx[0] = 1 is above upper_velocity_limit 0.75"));
  CHECK(contains(refused(at(0.0, -1e-6)), "below lower_velocity_limit 0"));
  CHECK(contains(refused(at(0.4, 0.0).with_parameter("block.upper_limit", 0.25)), "block 'block'"));
  for (const double end : {0.5, 0.75, 1.0, 2.0}) {
    const Results first = simulate(scene.diagram, begin, {0.0, end});
    const Results second = simulate(scene.diagram, first.context, {end, 3.0});
    CHECK_THAT(second.context.continuous_state()[0], WithinAbs(0.5, rounding));
    // The same state as a beginning: at the limits, or beyond them by rounding.
    const Context anew = begin.with_continuous_state(first.context.continuous_state());
    CHECK_NOTHROW(simulate(scene.diagram, anew, {0.0, 1.0}));
  }
}
