// Blocks in runs, against closed forms: their events are located, their time events exact.
#include <cmath>
#include <numbers>

#include "library_support.hpp"
#include "saltus/simulation/simulate.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double pi = std::numbers::pi;

/// Values of a recorded signal at given times, one column wide.
Numbers at_times(const System& system, OutputPort port, const std::vector<double>& times,
                 double rtol = 1e-10) {
  const auto results = simulate(system, system.create_context(), {0.0, times.back()},
                                {.rtol = rtol,
                                 .atol = 1e-12,
                                 .recorded_signals = {{"y", port}},
                                 .save_at = times,
                                 .save_steps = false});
  const auto y = results.output("y");
  Numbers values;
  for (const double t : times) {  // the last row of that time: after what happened there
    for (std::size_t row = results.time.size(); row-- > 0;) {
      if (results.time[row] != t) continue;
      values.push_back(y(static_cast<Index>(row), 0));
      break;
    }
  }
  REQUIRE(values.size() == times.size());
  return values;
}

/// The integral of a block's output from 0 to t, its inputs being what `connect` makes of them.
template <class Block, class Connect, class... Arguments>
double integral(double t, Connect connect, Arguments&&... arguments) {
  DiagramBuilder builder;
  auto& block = builder.add<Block>("block", std::forward<Arguments>(arguments)...);
  auto& sum = builder.add<Integrator>("sum");
  connect(builder, block);
  builder.connect(block.output(), sum.input());
  const Diagram diagram = builder.build();
  return at_times(diagram, sum.output(), {t}).back();
}

const auto no_inputs = [](DiagramBuilder&, auto&) {};

/// Errors of the integrals: 10 (rtol |x| + atol) with |x| < 10 and rtol = 1e-10.
constexpr double solver_tolerance = 1e-8;

/// Where the integrand is piecewise linear or flat, a Runge-Kutta step is exact: what is left is
/// rounding, a few eps of |x| < 10 for each of at most 100 pieces.
constexpr double rounding = 1e-12;

}  // namespace

TEST_CASE("the integral of |sin t| is exact across its kinks", "[library][dynamics]") {
  const auto sine = [](DiagramBuilder& builder, Abs& abs) {
    builder.connect(builder.add<Sine>("sine").output(), abs.input());
  };
  CHECK_THAT(integral<Abs>(10.0, sine),
             WithinAbs(6.0 + 1.0 - std::cos(10.0 - 3.0 * pi), solver_tolerance));
}

TEST_CASE("Abs of a constant of either sign is right where it reaches a derivative",
          "[library][dynamics]") {
  const auto constant = [](double value) {
    return [value](DiagramBuilder& builder, Abs& abs) {
      builder.connect(builder.add<Constant>("constant", value).output(), abs.input());
    };
  };
  CHECK_THAT(integral<Abs>(2.0, constant(-3.0)), WithinAbs(6.0, rounding));
  CHECK_THAT(integral<Abs>(2.0, constant(3.0)), WithinAbs(6.0, rounding));
}

TEST_CASE("the integral of a saturated sine is exact across the limits", "[library][dynamics]") {
  const auto sine = [](DiagramBuilder& builder, Saturate& saturate) {
    builder.connect(builder.add<Sine>("sine", Sine::Options{.amplitude = 2.0}).output(),
                    saturate.input());
  };
  const double exact =
      4.0 * (1.0 - std::cos(pi / 6.0)) + 2.0 * pi / 3.0;  // two flanks and the plateau
  CHECK_THAT(
      integral<Saturate>(pi, sine, Saturate::Options{.lower_limit = -1.0, .upper_limit = 1.0}),
      WithinAbs(exact, solver_tolerance));
}

TEST_CASE("a Switch with a threshold switches where the control reaches it",
          "[library][dynamics]") {
  const auto inputs = [](DiagramBuilder& builder, Switch& choice) {
    builder.connect(builder.add<Constant>("two", 2.0).output(), choice.input("true_value"));
    builder.connect(builder.add<Clock>("clock").output(), choice.input("control"));
    builder.connect(builder.add<Constant>("minus_one", -1.0).output(), choice.input("false_value"));
  };
  CHECK_THAT(integral<Switch>(3.0, inputs, Switch::Options{.threshold = 1.0}),
             WithinAbs(3.0, rounding));
}

TEST_CASE("a Comparator behind a Switch is located", "[library][dynamics]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& above = builder.add<Comparator>("above", ">");
  auto& choice = builder.add<Switch>("choice");
  auto& sum = builder.add<Integrator>("sum");
  builder.connect(sine.output(), above.input(0));
  builder.connect(zero.output(), above.input(1));
  builder.connect(sine.output(), choice.input("true_value"));
  builder.connect(above.output(), choice.input("control"));
  builder.connect(zero.output(), choice.input("false_value"));
  builder.connect(choice.output(), sum.input());
  const Diagram diagram = builder.build();
  CHECK_THAT(at_times(diagram, sum.output(), {4.0 * pi}).back(), WithinAbs(4.0, solver_tolerance));
}

TEST_CASE("both edges of a Pulse are exact", "[library][dynamics]") {
  const Pulse::Options pulse{.amplitude = 2.0, .period = 1.0 / 3.0, .pulse_width = 0.3};
  CHECK_THAT(integral<Pulse>(10.0, no_inputs, pulse), WithinAbs(6.0, rounding));
  const Pulse::Options late{.period = 1.0, .pulse_width = 0.5, .phase_delay = 0.25};
  CHECK_THAT(integral<Pulse>(2.5, no_inputs, late), WithinAbs(1.25, rounding));
}

TEST_CASE("Step and Ramp change exactly at their time", "[library][dynamics]") {
  CHECK_THAT(integral<Step>(2.0, no_inputs,
                            Step::Options{.start_value = 1.0, .end_value = -1.0, .step_time = 0.3}),
             WithinAbs(0.3 - 1.7, rounding));
  CHECK_THAT(integral<Ramp>(2.0, no_inputs,
                            Ramp::Options{.start_value = 1.0, .slope = 2.0, .start_time = 0.5}),
             WithinAbs(2.0 + 1.5 * 1.5, rounding));
}

TEST_CASE("a Step that falls on another event within rounding is not missed",
          "[library][dynamics]") {
  DiagramBuilder builder;
  auto& early = builder.add<Step>("early", Step::Options{.step_time = 0.3});
  auto& late =
      builder.add<Step>("late", Step::Options{.step_time = 3.0 * 0.1});  // one ulp after 0.3
  auto& sum = builder.add<Adder>("sum", "++");
  auto& integrator = builder.add<Integrator>("integrator");
  builder.connect(early.output(), sum.input(0));
  builder.connect(late.output(), sum.input(1));
  builder.connect(sum.output(), integrator.input());
  const Diagram diagram = builder.build();
  CHECK_THAT(at_times(diagram, integrator.output(), {1.3}).back(), WithinAbs(2.0, rounding));
}

TEST_CASE("n unit delays in a row delay n ticks", "[library][dynamics]") {
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& third = builder.add<UnitDelay>("third", 0.5, UnitDelay::Options{.initial_state = -3.0});
  auto& second = builder.add<UnitDelay>("second", 0.5, UnitDelay::Options{.initial_state = -2.0});
  auto& first = builder.add<UnitDelay>("first", 0.5, UnitDelay::Options{.initial_state = -1.0});
  builder.connect(clock.output(), first.input());
  builder.connect(first.output(), second.input());
  builder.connect(second.output(), third.input());
  const Diagram diagram = builder.build();
  const std::vector<double> between_ticks{0.25, 0.75, 1.25, 1.75, 2.25};
  CHECK(at_times(diagram, first.output(), between_ticks) == Numbers{-1.0, 0.0, 0.5, 1.0, 1.5});
  CHECK(at_times(diagram, second.output(), between_ticks) == Numbers{-2.0, -1.0, 0.0, 0.5, 1.0});
  CHECK(at_times(diagram, third.output(), between_ticks) == Numbers{-3.0, -2.0, -1.0, 0.0, 0.5});
}

TEST_CASE("a unit delay around an Adder counts its ticks, 1000 of 1/3 s", "[library][dynamics]") {
  DiagramBuilder builder;
  auto& one = builder.add<Constant>("one", 1.0);
  auto& sum = builder.add<Adder>("sum", "++");
  auto& count = builder.add<UnitDelay>("count", 1.0 / 3.0);
  builder.connect(count.output(), sum.input(0));
  builder.connect(one.output(), sum.input(1));
  builder.connect(sum.output(), count.input());
  const Diagram diagram = builder.build();
  CHECK(at_times(diagram, count.output(), {0.1, 0.4, 333.4}) == Numbers{0.0, 1.0, 1000.0});
}

TEST_CASE("ZeroOrderHold holds what it saw at its ticks", "[library][dynamics]") {
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.5);
  builder.connect(clock.output(), hold.input());
  const Diagram diagram = builder.build();
  CHECK(at_times(diagram, hold.output(), {0.1, 0.49, 0.6, 1.9}) == Numbers{0.0, 0.0, 0.5, 1.5});
}

TEST_CASE("an Integrator with limits waits at a limit until its input turns",
          "[library][dynamics]") {
  DiagramBuilder builder;
  auto& cosine = builder.add<Sine>("cosine", Sine::Options{.phase = pi / 2.0});
  auto& limited = builder.add<Integrator>(
      "limited",
      Integrator::Options{.enable_limits = true, .lower_limit = -0.5, .upper_limit = 0.5});
  builder.connect(cosine.output(), limited.input());
  const Diagram diagram = builder.build();
  // Up to 0.5 at pi/6, there until pi/2, down to -0.5 at pi, there until 3 pi/2, up to 0.5 at 2 pi,
  // there until 5 pi/2.
  const std::vector<double> t{0.1 * pi,  0.3 * pi,  0.75 * pi, 1.25 * pi,
                              1.75 * pi, 2.25 * pi, 2.75 * pi};
  const Numbers x = at_times(diagram, limited.output(), t);
  const Numbers exact{std::sin(t[0]),       0.5, std::sin(t[2]) - 0.5, -0.5,
                      std::sin(t[4]) + 0.5, 0.5, std::sin(t[6]) - 0.5};
  for (std::size_t i = 0; i < t.size(); ++i)
    CHECK_THAT(x[i], WithinAbs(exact[i], solver_tolerance));
}

TEST_CASE("an Integrator that starts at its limit is held there, and leaves it inward",
          "[library][dynamics]") {
  const auto end = [](double u) {
    DiagramBuilder builder;
    auto& constant = builder.add<Constant>("constant", u);
    auto& limited = builder.add<Integrator>(
        "limited",
        Integrator::Options{.initial_state = 1.0, .enable_limits = true, .upper_limit = 1.0});
    builder.connect(constant.output(), limited.input());
    const Diagram diagram = builder.build();
    return at_times(diagram, limited.output(), {2.0}).back();
  };
  CHECK(end(3.0) == 1.0);
  CHECK_THAT(end(-3.0), WithinAbs(-5.0, rounding));
}

TEST_CASE("limits hold for each entry of a vector by itself", "[library][dynamics]") {
  DiagramBuilder builder;
  auto& u = builder.add<Constant>("u", Value{1.0, -1.0, 2.0});
  auto& limited =
      builder.add<Integrator>("limited", Integrator::Options{.initial_state = {0.0, 0.0, 0.0},
                                                             .enable_limits = true,
                                                             .lower_limit = -0.5,
                                                             .upper_limit = Value{0.25, 9.0, 1.5}});
  builder.connect(u.output(), limited.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 5.0}, {.rtol = 1e-10, .atol = 1e-12});
  const Eigen::VectorXd x = results.context.continuous_state();
  CHECK_THAT(x[0], WithinAbs(0.25, rounding));
  CHECK_THAT(x[1], WithinAbs(-0.5, rounding));
  CHECK_THAT(x[2], WithinAbs(1.5, rounding));
}

TEST_CASE("an Integrator stands still while hold_trigger is true", "[library][dynamics]") {
  DiagramBuilder builder;
  auto& one = builder.add<Constant>("one", 1.0);
  auto& pulse = builder.add<Pulse>("pulse", Pulse::Options{.period = 1.0, .pulse_width = 0.25});
  auto& integrator =
      builder.add<Integrator>("integrator", Integrator::Options{.enable_hold = true});
  builder.connect(one.output(), integrator.input());
  builder.connect(pulse.output(), integrator.input("hold_trigger"));
  const Diagram diagram = builder.build();
  const Numbers x = at_times(diagram, integrator.output(), {0.25, 1.0, 4.5});
  CHECK_THAT(x[0], WithinAbs(0.0, rounding));
  CHECK_THAT(x[1], WithinAbs(0.75, rounding));
  CHECK_THAT(x[2], WithinAbs(3.25, rounding));
}

TEST_CASE("a reset to initial_state makes a sawtooth", "[library][dynamics]") {
  DiagramBuilder builder;
  auto& one = builder.add<Constant>("one", 1.0);
  auto& full = builder.add<Comparator>("full", ">=");
  auto& integrator = builder.add<Integrator>(
      "integrator", Integrator::Options{.initial_state = 0.25, .enable_reset = true});
  builder.connect(one.output(), integrator.input());
  builder.connect(integrator.output(), full.input(0));
  builder.connect(one.output(), full.input(1));
  builder.connect(full.output(), integrator.input("reset_trigger"));
  const Diagram diagram = builder.build();
  const Numbers x = at_times(diagram, integrator.output(), {0.5, 0.8, 7.6});
  CHECK_THAT(x[0], WithinAbs(0.75, rounding));
  CHECK_THAT(x[1], WithinAbs(0.3, rounding));
  CHECK_THAT(x[2], WithinAbs(0.35, rounding));
}

TEST_CASE("an external reset takes the value of its input at the rising edge only",
          "[library][dynamics]") {
  DiagramBuilder builder;
  auto& one = builder.add<Constant>("one", 1.0);
  auto& pulse = builder.add<Pulse>(
      "pulse", Pulse::Options{.period = 2.0, .pulse_width = 0.5, .phase_delay = 1.0});
  auto& ten = builder.add<Constant>("ten", 10.0);
  auto& integrator = builder.add<Integrator>(
      "integrator", Integrator::Options{.enable_reset = true, .enable_external_reset = true});
  builder.connect(one.output(), integrator.input());
  builder.connect(pulse.output(), integrator.input("reset_trigger"));
  builder.connect(ten.output(), integrator.input("reset_value"));
  const Diagram diagram = builder.build();
  const Numbers x = at_times(diagram, integrator.output(), {0.5, 1.5, 2.5, 3.5});
  CHECK_THAT(x[0], WithinAbs(0.5, rounding));
  CHECK_THAT(x[1], WithinAbs(10.5, rounding));
  CHECK_THAT(x[2], WithinAbs(11.5, rounding));
  CHECK_THAT(x[3], WithinAbs(10.5, rounding));
}
