// Guards that vary faster than the state: a step of the method spans many of their periods, and
// each pair of crossings is found.
#include "support/cases.hpp"
#include "support/oscillator.hpp"
#include "support/sine.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);
constexpr double end = 12.0;

/// An oscillator, whose steps are about a second, with a guard that the time moves, and which leaves
/// the state as it is.
std::shared_ptr<Leaf> oscillator(double frequency, double level, bool counts) {
  return make_leaf("leaf", [=](Leaf& l) {
    declare_oscillator(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "hit",
         .guard = [=](const At& at) { return std::sin(frequency * at.time + 0.4) - level; },
         .reset_map = counts ? ResetMap(count_up) : ResetMap()});
  });
}

}  // namespace

TEST_CASE("every crossing of a guard that is faster than the state is found", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double frequency = GENERATE(3.0, 17.0, 60.0), level = GENERATE(0.5, -0.9, 0.99, -0.99);
  const bool counts = GENERATE(true, false);
  for (const double rtol : {1e-3, 1e-9}) {
    const auto leaf = oscillator(frequency, level, counts);
    const auto results = simulate(*leaf, leaf->create_context(), {0.0, end},
                                  {.rtol = rtol, .atol = 0.01 * rtol, .ode_solver_method = method});
    // The slope at a crossing is w sqrt(1 - level^2); the angle has some roundings of 720.
    const double slope = frequency * std::sqrt(1.0 - level * level);
    within(text("fast guard ", frequency, " ", level, " ", rtol, counts ? "" : ", monitor"), method,
           worst(firing_times(results.events), sine_crossings(frequency, level, end)),
           8.0 * eps * (frequency * end) / slope + 200.0 * eps * end);
  }
}

/// While the state rests, the steps of a method have no limit: a step of 2 000 s has 1 592 periods of
/// the guard.
TEST_CASE("the crossings of a guard of time alone are found beside a state at rest",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double frequency = GENERATE(0.3, 5.0, 50.0);
  const double last = 2000.0;
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(1, [](const At&, VectorRef xdot) { xdot[0] = 0.0; });
    l.declare_zero_crossing(
        {.name = "hit",
         .guard = [=](const At& at) { return std::sin(frequency * at.time + 0.4) - 0.5; },
         .direction = Direction::negative_then_non_negative});
  });
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, last},
                                {.ode_solver_method = method, .save_steps = false});
  std::vector<double> expected;
  for (double k = 0.0;; k += 1.0) {
    const double t = (std::asin(0.5) + 2.0 * pi * k - 0.4) / frequency;
    if (t > last) break;
    if (t > 0.0) expected.push_back(t);
  }
  // as above, with an angle of up to 1e5
  const double slope = frequency * std::sqrt(0.75);
  within(text("state at rest ", frequency), method, worst(firing_times(results.events), expected),
         8.0 * eps * (frequency * last) / slope + 200.0 * eps * last);
}

TEST_CASE("a guard that no look resolves does not end the looks at the others", "[laws][guards]") {
  // A monitor that is noise, and never zero, beside one with three periods in a second.
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    declare_oscillator(l);
    l.declare_zero_crossing({.name = "noise", .guard = [](const At& at) {
                               return 1e-3 * std::sin(1.2e9 * at.time) + 2e-3;
                             }});
    l.declare_zero_crossing({.name = "hit", .guard = [](const At& at) {
                               return std::sin(17.0 * at.time + 0.4) - 0.5;
                             }});
  });
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, end},
                                {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = method});
  const double slope = 17.0 * std::sqrt(0.75);
  within("fast guard beside noise", method,
         worst(firing_times(results.events), sine_crossings(17.0, 0.5, end)),
         8.0 * eps * (17.0 * end) / slope + 200.0 * eps * end);
}

TEST_CASE("a first step of many periods shows all crossings", "[laws][guards]") {
  // One step is the whole run, because the derivative is constant.
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::radau);
  const double frequency = GENERATE(1.3, 2.4, 3.7, 5.0, 11.0), level = GENERATE(0.5, -0.9);
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "hit", .guard = [=](const At& at) {
                               return std::sin(frequency * at.time + 0.4) - level;
                             }});
  });
  SimulatorOptions options;
  options.ode_solver_method = method, options.first_step = end;
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, end}, options);
  const double slope = frequency * std::sqrt(1.0 - level * level);
  within(text("long first step ", frequency, " ", level), method,
         worst(firing_times(results.events), sine_crossings(frequency, level, end)),
         8.0 * eps * (frequency * end) / slope + 200.0 * eps * end);
}
