// Sources: their values, shapes, rates and time events.
#include <cmath>
#include <limits>
#include "saltus/plan/compile.hpp"
#include "saltus/plan/detail/machine.hpp"

#include "library_support.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

TEST_CASE("Constant is a view of its parameter, scalar or vector", "[library]") {
  Bench<Constant> scalar({}, -9.81), vector({}, Value{1.0, 2.0, 3.0});
  CHECK(scalar.output() == Numbers{-9.81});
  CHECK(scalar.node().shape == Shape::scalar());
  CHECK(vector.output() == Numbers{1.0, 2.0, 3.0});
  CHECK(vector.node().shape == Shape::of(3));
  CHECK(scalar.node().view);
  CHECK(scalar.node().rate == Rate::constant);
  CHECK(scalar.plan().needs.constants.empty());
}

TEST_CASE("a context can change the value of a Constant", "[library]") {
  const Constant constant("constant", 1.0);
  const auto plan = compile(constant, {{"y", constant.output()}});
  Machine machine(plan);
  machine.load(constant.create_context().with_parameter("value", 2.5));
  CHECK(*machine.value(plan->node(0).place) == 2.5);
}

TEST_CASE("Step switches at step_time, not before and not after", "[library]") {
  const double before =
      2.0 - 1e-14;  // times closer than that count as one instant: 16 eps of 2 s is 7e-15 s
  Bench<Step> step({}, Step::Options{.start_value = 5.0, .end_value = -1.0, .step_time = 2.0});
  CHECK(step.output(0, 0.0) == Numbers{5.0});
  CHECK(step.output(0, before) == Numbers{5.0});
  CHECK(step.output(0, 2.0) == Numbers{-1.0});
  CHECK(step.output(0, 9.0) == Numbers{-1.0});
  CHECK(step.node().rate == Rate::held);
  REQUIRE(step.plan().schedule.size() == 1);
  CHECK(step.plan().schedule[0].offset == 2.0);
  CHECK(std::isinf(step.plan().schedule[0].period));
}

TEST_CASE("a Step between a number and a vector is a vector", "[library]") {
  Bench<Step> step({},
                   Step::Options{.start_value = 0.0, .end_value = {1.0, 2.0}, .step_time = 1.0});
  CHECK(step.output(0, 0.0) == Numbers{0.0, 0.0});
  CHECK(step.output(0, 1.0) == Numbers{1.0, 2.0});
  CHECK(step.node().shape == Shape::of(2));
}

TEST_CASE("Sine is amplitude sin(frequency t + phase) + bias, entry by entry", "[library]") {
  Bench<Sine> sine(
      {},
      Sine::Options{.amplitude = {2.0, 3.0}, .frequency = 4.0, .phase = {0.0, 0.5}, .bias = 1.0});
  // The same formula in the same order: rounding of one sine, product and sum, 3 eps of a value
  // below 4.
  const double tolerance = 12.0 * std::numeric_limits<double>::epsilon();
  for (const double t : {0.0, 0.3, 7.0}) {
    const Numbers y = sine.output(0, t);
    CHECK_THAT(y[0], WithinAbs(2.0 * std::sin(4.0 * t) + 1.0, tolerance));
    CHECK_THAT(y[1], WithinAbs(3.0 * std::sin(4.0 * t + 0.5) + 1.0, tolerance));
  }
  CHECK(sine.node().rate == Rate::continuous);
  CHECK(sine.plan().schedule.empty());
}

TEST_CASE("Clock shows the time", "[library]") {
  Bench<Clock> clock({});
  CHECK(clock.output(0, 1.25) == Numbers{1.25});
  CHECK(clock.node().rate == Rate::continuous);
}

TEST_CASE("Ramp is flat, then a line, and its kink is an exact stop", "[library]") {
  Bench<Ramp> ramp({}, Ramp::Options{.start_value = 1.0, .slope = {2.0, -4.0}, .start_time = 0.5});
  CHECK(ramp.output(0, 0.0) == Numbers{1.0, 1.0});
  CHECK(ramp.output(0, 0.5) == Numbers{1.0, 1.0});
  CHECK(ramp.output(0, 1.0) ==
        Numbers{2.0, -1.0});  // exact: all numbers are short binary fractions
  CHECK(ramp.node().rate == Rate::continuous);
  REQUIRE(ramp.plan().schedule.size() == 1);
  CHECK(ramp.plan().schedule[0].offset == 0.5);
}

TEST_CASE(
    "Pulse is high exactly from each rise to each fall, ticks being offset + k period as doubles",
    "[library]") {
  const double period = 1.0 / 3.0, width = 0.3, delay = 0.1;
  Bench<Pulse> pulse(
      {}, Pulse::Options{
              .amplitude = 2.0, .period = period, .pulse_width = width, .phase_delay = delay});
  REQUIRE(pulse.plan().schedule.size() == 2);
  const double rise = pulse.plan().schedule[0].offset, fall = pulse.plan().schedule[1].offset;
  CHECK(pulse.output(0, 0.0) == Numbers{0.0});
  CHECK(pulse.output(0, 0.099) == Numbers{0.0});
  for (int k = 0; k < 1000; ++k) {
    CHECK(pulse.output(0, rise + k * period) == Numbers{2.0});
    CHECK(pulse.output(0, fall + k * period) == Numbers{0.0});
  }
  CHECK(pulse.node().rate == Rate::held);
}

TEST_CASE("a Pulse of width 0 is always low, one of width 1 always high from its delay on",
          "[library]") {
  Bench<Pulse> low({}, Pulse::Options{.period = 0.1, .pulse_width = 0.0});
  Bench<Pulse> high({}, Pulse::Options{.period = 0.1, .pulse_width = 1.0, .phase_delay = 0.7});
  CHECK(high.output(0, 0.6) == Numbers{0.0});
  for (int k = 0; k < 1000; ++k) {
    CHECK(low.output(0, k * 0.1) == Numbers{0.0});
    CHECK(high.output(0, 0.7 + k * 0.1) == Numbers{1.0});
  }
}

TEST_CASE("a Pulse refuses a period or width that makes no pulse", "[library]") {
  CHECK(model_error([] { Pulse("p", Pulse::Options{.period = 0.0}); }) ==
        "block 'p': period = 0 s; expected a finite time > 0 s");
  CHECK(contains(model_error([] { Pulse("p", Pulse::Options{.pulse_width = 1.5}); }),
                 "pulse_width = 1.5"));
}
