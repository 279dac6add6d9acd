// Where events may fall: anywhere, at t0, at the end, at a tick; with and without continuous state.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A guard t - `at`, counted; with a state that has nothing to do with it, or none.
Leaf alarm(double at_time, bool with_state, bool terminal = false) {
  return Leaf("alarm", [=](Leaf& l) {
    if (with_state)
      l.declare_continuous_state(
          {.initial = vec({1.0}), .ode = [](const At& at) { return -at.x[0]; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("count");
    l.declare_zero_crossing({.name = "alarm",
                             .guard = [=](const At& at) { return at.time - at_time; },
                             .reset_map = count_up,
                             .terminal = terminal});
  });
}

}  // namespace

TEST_CASE("a guard on time only is located, with continuous state and without", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_state = GENERATE(true, false);
  const double at = GENERATE(0.537, 0.123, 0.5);
  INFO("method " << method << ", at " << at << ", state " << with_state);
  const Leaf leaf = alarm(at, with_state);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 1);
  CHECK_THAT(results.events[0].time, WithinAbs(at, 100.0 * eps * 2.0));  // 100 eps (|t| + |h|)
  CHECK(results.events[0].time >= at);
  CHECK(results.context.discrete_state()[0] == 1.0);
}

TEST_CASE("an event exactly at the end of a run happens, once, also if the run goes on",
          "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_state = GENERATE(true, false);
  INFO("method " << method << ", state " << with_state);
  const Leaf leaf = alarm(1.0, with_state);
  const SimulatorOptions options{.ode_solver_method = method};
  const auto first = simulate(leaf, leaf.create_context(), {0.0, 1.0}, options);
  CHECK(first.context.discrete_state()[0] == 1.0);
  CHECK(first.events.size() == 1);
  const auto second = simulate(leaf, first.context, {1.0, 2.0}, options);
  CHECK(second.context.discrete_state()[0] == 1.0);
  CHECK(second.events.empty());
}

TEST_CASE("a time event exactly at t0 and exactly at the end happens", "[laws][events]") {
  const bool with_state = GENERATE(true, false);
  const Leaf leaf("leaf", [&](Leaf& l) {
    if (with_state) declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(2.0, count_up, "start");
    l.declare_one_shot(3.0, count_up, "end");
  });
  const auto results = simulate(leaf, leaf.create_context(2.0), {2.0, 3.0});
  CHECK(results.context.discrete_state()[0] == 2.0);
  REQUIRE(results.events.size() == 2);
  CHECK(results.events[0].time == 2.0);
  CHECK(results.events[1].time == 3.0);
}

TEST_CASE("a guard that reaches zero exactly at a tick fires, and the tick happens",
          "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_zero_crossing(
        {.name = "reached",
         .guard = [](const At& at) { return at.x[0] - 0.5; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({at.z[0] + 1.0, at.z[1]}); }});
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({at.z[0], at.z[1] + 1.0}); }, 0.25,
        0.25);
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  // Counted in the log: if both fall into one pass, both write z and the later declaration stays.
  CHECK(count(results.events, EventKind::zero_crossing) == 1);
  CHECK(count(results.events, EventKind::time) == 4);
  CHECK(results.context.discrete_state()[1] == 4.0);
}

TEST_CASE("a terminal event ends the run after its reset, with the row after it",
          "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l, -3.0, 2.0);
    l.declare_zero_crossing(
        {.name = "empty",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({7.0}); },
         .terminal = true});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 10.0},
               {.ode_solver_method = method, .recorded_signals = {{"x", leaf.output()}}});
  CHECK(results.status == Status::terminal);
  CHECK_THAT(results.context.time(), WithinAbs(2.0 / 3.0, 1e-9));
  CHECK(results.context.continuous_state()[0] == 7.0);
  REQUIRE(results.time.size() >= 2);
  CHECK(results.time.back() == results.context.time());
  CHECK(results.time[results.time.size() - 2] == results.context.time());
  const auto x = column(results, "x");
  CHECK(x.back() == 7.0);
  CHECK_THAT(x[x.size() - 2], WithinAbs(0.0, 1e-9));
  CHECK(count(results.events, EventKind::terminal) == 1);
}

TEST_CASE("a terminal event on time alone ends a run without continuous state", "[laws][events]") {
  const Leaf leaf = alarm(0.15, false, true);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 1.0});
  CHECK(results.status == Status::terminal);
  CHECK_THAT(results.context.time(), WithinAbs(0.15, 100.0 * eps));
}

TEST_CASE("a terminal guard at zero at the start waits: an orbit starts on its own finish line",
          "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const double pi = std::acos(-1.0);
  const Leaf orbit("orbit", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << -at.x[1], at.x[0]; }});
    l.declare_zero_crossing({.name = "finish",
                             .guard = [](const At& at) { return at.x[1]; },
                             .direction = Direction::negative_then_non_negative,
                             .terminal = true});
  });
  const auto results = simulate(orbit, orbit.create_context(), {0.0, 20.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  CHECK(results.status == Status::terminal);
  CHECK_THAT(results.context.time(), WithinAbs(2.0 * pi, 1e-6));
}
