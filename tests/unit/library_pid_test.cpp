// PID: its law, its limits and its clamp.
#include <cmath>

#include "library_runs.hpp"
#include "saltus/library/pid.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

/// The number of times that the integral was clamped at a limit, or released.
std::size_t changes(const Results& results, const std::string& limit) {
  return results.events.times("block.clamp_at_" + limit).size();
}

/// An integrating plant x' = y from x = 0, whose controller sees 1 - x.
struct Loop {
  explicit Loop(const PID::Options& options) : diagram(build(options)) {}
  static Diagram build(const PID::Options& options) {
    DiagramBuilder builder;
    auto& target = builder.add<Constant>("target", 1.0);
    auto& error = builder.add<Adder>("error", "+-");
    auto& block = builder.add<PID>("block", options);
    auto& x = builder.add<Integrator>("x");
    builder.connect(target.output(), error.input(0));
    builder.connect(x.output(), error.input(1));
    builder.connect(error.output(), block.input());
    builder.connect(block.output(), x.input());
    return builder.build();
  }
  Numbers x(const std::vector<double>& times) const {
    return at_times(diagram, diagram["x"].output(), times);
  }
  Diagram diagram;
};

}  // namespace

/// For u = t: the integral is t^2 / 2, the filtered derivative 1 - e^(-n t).
TEST_CASE("a PID adds the error, its integral and its filtered derivative", "[library][pid]") {
  const auto ramp = fed_by<Ramp>(Ramp::Options{.slope = 1.0, .start_time = 0.0});
  const PID::Options options{.kp = 2.0, .ki = 3.0, .kd = 0.5, .n = 10.0, .initial_state = 7.0};
  const std::vector<double> times{0.1, 1.0, 2.0};
  const Numbers y = BlockRun<PID>(ramp, options).at(times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    const double exact = 2.0 * t + 1.5 * t * t + 0.5 * (1.0 - std::exp(-10.0 * t)) + 7.0;
    CHECK_THAT(y[i], WithinAbs(exact, solver_tolerance));
  }
}

TEST_CASE("a PID without limits has no guard", "[library][pid]") {
  CHECK(Bench<PID>({1.0}).plan().guards.empty());
}

/// u = 1 up to 4 s, then -1. With ki = 1 the integral reaches the limit 2 at t = 1, as kp u = 1.
/// Clamped, it waits there, and falls from 1 as soon as the error turns; wound up, it would have
/// grown to 4.
TEST_CASE("the integral does not wind up beyond a limit", "[library][pid]") {
  const auto turn =
      fed_by<Step>(Step::Options{.start_value = 1.0, .end_value = -1.0, .step_time = 4.0});
  const PID::Options options{.kp = 1.0, .ki = 1.0, .lower_limit = -2.0, .upper_limit = 2.0};
  const BlockRun<PID> scene(turn, options);
  const Numbers y = scene.at({0.5, 1.5, 3.9, 4.5, 5.5, 6.5});
  const Numbers exact{1.5, 2.0, 2.0, -0.5, -1.5, -2.0};
  for (std::size_t i = 0; i < y.size(); ++i) CHECK_THAT(y[i], WithinAbs(exact[i], rounding));
  const auto results = scene.run(8.0);
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(-1.0, rounding));
  CHECK(changes(results, "upper_limit") == 2);
  CHECK(changes(results, "lower_limit") == 1);
}

TEST_CASE("a PID that starts beyond its limit is clamped from the start", "[library][pid]") {
  const PID::Options options{.kp = 5.0, .ki = 1.0, .upper_limit = 2.0};
  const BlockRun<PID> scene(fed_by<Constant>(1.0), options);
  CHECK(scene.at({0.0, 1.0}) == Numbers{2.0, 2.0});
  CHECK(scene.run(1.0).context.continuous_state()[0] == 0.0);
}

/// With ki = 0 there is nothing to clamp: the limits are those of a Saturate.
TEST_CASE("a PID without an integral has limits too", "[library][pid]") {
  const BlockRun<PID> scene(fed_by<Sine>(Sine::Options{}),
                            PID::Options{.kp = 2.0, .lower_limit = -1.0, .upper_limit = 1.0});
  const Numbers y = scene.at({0.1, 1.5, 3.0, 4.5, 6.2});
  const Numbers exact{2.0 * std::sin(0.1), 1.0, 2.0 * std::sin(3.0), -1.0, 2.0 * std::sin(6.2)};
  for (std::size_t i = 0; i < y.size(); ++i) CHECK_THAT(y[i], WithinAbs(exact[i], rounding));
  CHECK(scene.run(20.0).status == Status::reached_end);
}

/// The error decreases while the output is at its limit, so v would slide along the limit. The band
/// lets the integral go and takes it back a bounded number of times, and the loop settles.
TEST_CASE("a controller at its limit with a falling error does not chatter", "[library][pid]") {
  const Loop loop({.kp = 4.0, .ki = 20.0, .upper_limit = 1.0});
  const auto results =
      simulate(loop.diagram, loop.diagram.create_context(), {0.0, 30.0}, precise());
  CHECK(changes(results, "upper_limit") < 100);
  CHECK_THAT(loop.x({30.0})[0], WithinAbs(1.0, 1e-6));
}

TEST_CASE("a PID without a filter, or with limits that cross, is refused", "[library][pid]") {
  CHECK(contains(model_error([] { PID("c", {.n = 0.0}); }), "the derivative needs its filter"));
  CHECK(contains(model_error([] { PID("c", {.n = HUGE_VAL}); }), "give a finite value"));
  CHECK(contains(model_error([] { PID("c", {.lower_limit = 1.0, .upper_limit = 1.0}); }),
                 "lower_limit 1 is not below upper_limit 1"));
  CHECK(contains(model_error([] { PID("c", {.upper_limit = 1.0, .band = 0.0}); }), "band = 0"));
}
