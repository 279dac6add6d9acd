// Guards of signals that jump at an instant: at a kink of a block, at a time event, at a reset.
#include "support/bouncing.hpp"
#include "support/cases.hpp"
#include "support/input_watcher.hpp"
#include "support/sine.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double end = 20.0;

/// The times [s] at which the guard fires, where its input is this signal.
std::vector<double> firings(DiagramBuilder& builder, OutputPort signal, double level, bool counts,
                            Method method) {
  const auto guard = input_watcher("guard", [=](double u) { return u - level; }, counts);
  builder.add(guard);
  builder.connect(signal, guard->input("u"));
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, end}, {.ode_solver_method = method});
  return results.events.times("guard.hit");
}

/// 0.1 while sin(t + 0.4) is below the level 0.5, and 0.6 above it: the output of a saturation at 0.4
/// jumps at its limit.
std::vector<double> behind_a_saturation(double level, bool counts, bool moves, Method method) {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{.phase = 0.4});
  auto& stairs = builder.add<FunctionBlock>("stairs", [](double u) { return u < 0.5 ? 0.1 : 0.6; });
  auto& limit =
      builder.add<Saturate>("limit", SaturateOptions{.lower_limit = -0.4, .upper_limit = 0.4});
  builder.connect(sine.output(), stairs.input());
  builder.connect(stairs.output(), limit.input());
  if (moves) {
    auto& x = builder.add<Integrator>("x", Integrator::Options{});
    builder.connect(sine.output(), x.input());
  }
  return firings(builder, limit.output(), level, counts, method);
}

/// Roundings of the time, and of the angle at a slope of 0.86.
constexpr double roundings = 200.0 * eps * end;

}  // namespace

/// A look at the jump holds "below the limit", so it shows 0.6. The guard has never been there.
TEST_CASE("a signal that jumps across the limit of a block is not beyond it", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool counts = GENERATE(true, false), moves = GENERATE(false, true);
  INFO("method " << method << (counts ? ", reset map" : ", monitor") << (moves ? ", a state" : ""));
  for (const double level : {0.41, 0.45, 0.59})
    CHECK(behind_a_saturation(level, counts, moves, method).empty());
}

TEST_CASE(
    "a guard or monitor is found where its signal jumps across it within the limits of a block",
    "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool counts = GENERATE(true, false), moves = GENERATE(false, true);
  const std::vector<double> found = behind_a_saturation(0.3, counts, moves, method);
  within(text("jump at a limit", counts ? "" : ", monitor", moves ? ", a state" : ""), method,
         worst(found, sine_crossings(1.0, 0.5, end)), roundings);
}

TEST_CASE("a monitor logs the jumps of a relay and of a pulse, as a guard with a reset map does",
          "[laws][monitors]") {
  const auto method = GENERATE(Method::dopri5, Method::bdf);
  const auto relay = [&](bool counts) {
    DiagramBuilder builder;
    auto& sine = builder.add<Sine>("sine", SineOptions{.phase = 0.4});
    auto& switched =
        builder.add<Relay>("relay", RelayOptions{.on_threshold = 0.5, .off_value = -1.0});
    builder.connect(sine.output(), switched.input());
    return firings(builder, switched.output(), 0.25, counts, method);
  };
  const auto pulse = [&](bool counts) {
    DiagramBuilder builder;
    auto& rises = builder.add<Pulse>(
        "pulse", PulseOptions{.period = 3.0, .pulse_width = 0.5, .phase_delay = 1.0});
    return firings(builder, rises.output(), 0.25, counts, method);
  };
  CHECK(relay(true).size() == 7);  // on at 0.5, off at 0, in 20 s of a period of 6.3 s
  CHECK(relay(false) == relay(true));
  CHECK(pulse(false) == std::vector<double>{1.0, 2.5, 4.0, 5.5, 7.0, 8.5, 10.0, 11.5, 13.0, 14.5,
                                            16.0, 17.5, 19.0});
  CHECK(pulse(true) == pulse(false));
}

/// The velocity of a ball passes zero at each bounce and at each peak.
TEST_CASE("a monitor logs where a reset map takes its value across zero", "[laws][monitors]") {
  const auto method = GENERATE(from_range(methods));
  const auto run = [&](bool monitored) {
    const Leaf ball("ball", [&](Leaf& l) {
      declare_bouncing(l, 1.0, 10.0);
      if (!monitored) return;
      l.declare_zero_crossing({.name = "turn", .guard = [](const At& at) { return at.x[1]; }});
      l.declare_zero_crossing({.name = "rises",
                               .guard = [](const At& at) { return at.x[1]; },
                               .direction = Direction::negative_then_non_negative});
      l.declare_zero_crossing({.name = "falls",
                               .guard = [](const At& at) { return at.x[1]; },
                               .direction = Direction::positive_then_non_positive});
    });
    return simulate(ball, ball.create_context(), {0.0, 1.9}, {.ode_solver_method = method});
  };
  const auto with = run(true), without = run(false);
  INFO("method " << method);
  CHECK(with.time == without.time);
  CHECK(with.context.continuous_state() == without.context.continuous_state());
  const auto bounces = without.events.times("bounce");
  REQUIRE(bounces.size() == 3);  // after 0.45, 1.16 and 1.73 s
  CHECK(with.events.times("rises") == bounces);
  CHECK(with.events.times("falls").size() == 2);
  CHECK(with.events.times("turn").size() == 5);
}
