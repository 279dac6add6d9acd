// Semantics 3.14, 3.15 and 3.16: triggers that go back, triggers before the start, and the time at
// which values are computed.
#include <numbers>

#include "support/queued.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr auto rises = Direction::negative_then_non_negative;
constexpr auto falls = Direction::positive_then_non_positive;

std::vector<double> times(const Results& results, std::string_view name, EventKind kind) {
  return results.events.times(name, kind);
}

/// sin(2 pi t) is above zero for half a second, from each whole second on.
Leaf half_seconds(double delay, bool persistent) {
  return Leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "up",
         .guard = [](const At& at) { return std::sin(2.0 * std::numbers::pi * at.x[0]); },
         .reset_map = count_up,
         .direction = rises,
         .delay = delay,
         .persistent = persistent});
  });
}

}  // namespace

TEST_CASE("3.14 a trigger that goes back cancels its execution where it does so", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = half_seconds(0.7, false);
  const auto start = leaf.create_context().with_continuous_state({0.75}).with_time(0.75);
  const auto results = simulate(leaf, start, {0.75, 3.25},
                                {.ode_solver_method = method, .max_minor_step_size = 0.1});
  CHECK(times(results, "up", EventKind::scheduled).size() == 3);
  CHECK(times(results, "up", EventKind::executed).empty());
  const auto cancelled = times(results, "up", EventKind::cancelled);
  REQUIRE(cancelled.size() == 2);  // the third is still waiting
  // x = t to the tolerance of the run, 1e-6 of it.
  CHECK_THAT(cancelled[0], WithinAbs(1.5, 1e-5));
  CHECK_THAT(cancelled[1], WithinAbs(2.5, 1e-5));
  CHECK(results.context.discrete_state()[0] == 0.0);
  REQUIRE(results.context.pending() != nullptr);
  CHECK(results.context.pending()->all.size() == 1);
}

TEST_CASE("3.14 an execution that comes before the trigger goes back is not cancelled",
          "[semantics]") {
  const Leaf leaf = half_seconds(0.3, false);
  const auto start = leaf.create_context().with_continuous_state({0.75}).with_time(0.75);
  const auto results = simulate(leaf, start, {0.75, 3.4}, {.max_minor_step_size = 0.1});
  CHECK(times(results, "up", EventKind::executed).size() == 3);
  CHECK(times(results, "up", EventKind::cancelled).empty());
}

TEST_CASE("3.14 a trigger that goes back within its error bound is cancelled when it is due",
          "[semantics]") {
  // x rises to 1 and is turned round there, or x is put just above 1 and falls: the guard goes back
  // without a crossing that is beyond its error.
  const auto method = GENERATE(from_range(methods));
  const double above = GENERATE(0.0, 1e-9, 1e-7);
  INFO("method " << method << ", " << above);
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_discrete_state(vec({1.0}));
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return at.z[0]; }});
    const auto level = [](const At& at) { return at.x[0] - 1.0; };
    l.declare_zero_crossing(
        {.name = "late",
         .guard = level,
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({9.0}); },
         .direction = rises,
         .delay = 0.5,
         .persistent = false});
    l.declare_zero_crossing({.name = "turn",
                             .guard = level,
                             .reset_map =
                                 [=](const At&, Next& next) {
                                   next.set_discrete_state({-1.0});
                                   next.set_continuous_state({1.0 + above});
                                 },
                             .direction = rises});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  CHECK(times(results, "late", EventKind::executed).empty());
  CHECK(times(results, "late", EventKind::cancelled).size() == 1);
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(above, 1e-5));
}

TEST_CASE("3.14 a persistent one is executed, whatever its trigger does meanwhile", "[semantics]") {
  const Leaf leaf = half_seconds(0.7, true);
  const auto start = leaf.create_context().with_continuous_state({0.75}).with_time(0.75);
  const auto results = simulate(leaf, start, {0.75, 3.8}, {.max_minor_step_size = 0.1});
  CHECK(times(results, "up", EventKind::executed).size() == 3);
  CHECK(times(results, "up", EventKind::cancelled).empty());
}

TEST_CASE("3.14 an earlier execution of the same instant cancels, too", "[semantics]") {
  const bool persistent = GENERATE(true, false);
  const auto direction = GENERATE(rises, falls);
  INFO("persistent " << persistent << ", " << to_string(direction));
  const double sign = direction == rises ? 1.0 : -1.0;
  // Both trigger at 1 s; `first` carries the guard of `second` back.
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    const auto guard = [=](const At& at) { return sign * (at.x[0] - 1.0); };
    l.declare_zero_crossing(
        {.name = "first",
         .guard = guard,
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({-1.0}); },
         .direction = direction,
         .priority = 2.0});
    l.declare_zero_crossing({.name = "second",
                             .guard = guard,
                             .reset_map = count_up,
                             .direction = direction,
                             .priority = 1.0,
                             .persistent = persistent});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0});
  CHECK(times(results, "first", EventKind::executed).size() == 1);
  CHECK(times(results, "second", EventKind::executed).size() == (persistent ? 1 : 0));
  CHECK(times(results, "second", EventKind::cancelled).size() == (persistent ? 0 : 1));
}

TEST_CASE("3.14 a plain reset map of the pass of the trigger cancels, too", "[semantics]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_plain(l, [](const At&, Next& next) { next.set_continuous_state({0.5}); });
    l.declare_zero_crossing({.name = "queued",
                             .guard = beyond_one,
                             .reset_map = count_up,
                             .direction = rises,
                             .persistent = false});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 1.75});
  CHECK(times(results, "queued", EventKind::scheduled).size() == 2);
  CHECK(times(results, "queued", EventKind::cancelled).size() == 2);
  CHECK(results.context.discrete_state()[0] == 0.0);
}

TEST_CASE("3.15 initial_value is what the trigger was before the start", "[semantics]") {
  const double at_start = GENERATE(-1.0, 0.0, 2.0);
  const bool before = GENERATE(true, false);
  const bool persistent = GENERATE(true, false);
  INFO("x(0) = " << at_start << ", initial_value " << before << ", persistent " << persistent);
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({at_start}), .ode = [](const At&) { return 0.0; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "high",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = count_up,
                             .direction = rises,
                             .persistent = persistent,
                             .initial_value = before});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 1.0});
  // Zero counts as reached. A trigger that was on its firing side before has nothing to reach.
  const bool fires = !before && at_start >= 0.0;
  CHECK(times(results, "high", EventKind::executed) ==
        (fires ? std::vector{0.0} : std::vector<double>{}));
}

TEST_CASE("3.15 a trigger that counts as true before the start fires when it comes back",
          "[semantics]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At&) { return -1.0; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(2.0, [](const At&, Next& next) { next.set_continuous_state({3.0}); });
    l.declare_zero_crossing({.name = "high",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = count_up,
                             .direction = rises,
                             .initial_value = true});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 4.0});
  CHECK(times(results, "high", EventKind::executed) == std::vector{2.0});
}

TEST_CASE("3.16 values are computed at the execution, or at the trigger", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool early = GENERATE(true, false);
  INFO("method " << method << ", early " << early);
  // x' = 1, y' = 1; at x = 1 it is scheduled that y becomes 10 x, half a second later.
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = [](const At&, VectorRef xdot) { xdot.setOnes(); }});
    l.declare_zero_crossing(
        {.name = "copy",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.x[0], 10.0 * at.x[0]}); },
         .direction = rises,
         .delay = 0.5,
         .use_values_from_trigger_time = early});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  const Eigen::VectorXd x = results.context.continuous_state();
  CHECK_THAT(x[0], WithinAbs(2.0, 1e-8));  // not written: it flowed on
  CHECK_THAT(x[1], WithinAbs((early ? 10.0 : 15.0) + 0.5, 1e-6));
}

TEST_CASE("3.16 discrete states and the mode of the trigger time are written as well",
          "[semantics]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_default_mode(0);
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0, at.z[1]}); }, 1.0,
        1.0);
    l.declare_zero_crossing({.name = "copy",
                             .guard = [](const At& at) { return at.z[0] - 1.5; },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_discrete_state({at.z[0], 100.0 * at.z[0]});
                                   next.set_mode(static_cast<int>(at.z[0]));
                                 },
                             .direction = rises,
                             .delay = 2.5,
                             .use_values_from_trigger_time = true});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 4.75});
  CHECK(results.context.discrete_state() == vec({4.0, 200.0}));  // z[0] has counted on
  CHECK(results.context.mode() == 2);
}

TEST_CASE("3.16 values of two events that trigger at once are those of one state", "[semantics]") {
  // The classic swap: each takes the value of the other at the trigger.
  const bool early = GENERATE(true, false);
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({1.0, 2.0}));
    const auto guard = [](const At& at) { return at.x[0] - 1.0; };
    l.declare_zero_crossing(
        {.name = "a",
         .guard = guard,
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({at.z[1], at.z[1]}); },
         .direction = rises,
         .priority = 2.0,
         .use_values_from_trigger_time = early});
    l.declare_zero_crossing(
        {.name = "b",
         .guard = guard,
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({at.z[0], at.z[0]}); },
         .direction = rises,
         .priority = 1.0,
         .use_values_from_trigger_time = early});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0});
  CHECK(results.context.discrete_state() == (early ? vec({2.0, 1.0}) : vec({2.0, 2.0})));
}
