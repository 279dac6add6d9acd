// Semantics 3.11 and 3.13: what a trigger schedules, and what executions set off.
#include "support/queued.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr auto rises = Direction::negative_then_non_negative;

/// x' = 1 from 0; the queued zero crossing `late` triggers at x = 1 and sets x to 0.
Leaf delayed_ramp(NumberOf delay) {
  return Leaf("ramp", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "late",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = rises,
         .delay = delay});
  });
}

/// z[0] is the side of two queued zero crossings that set each other off, from the kick at 1 s on.
Leaf pair(double delay, double rate = 1.0) {
  return Leaf("pair", [=](Leaf& l) {
    declare_ramp(l, rate);
    l.declare_discrete_state(vec({-1.0}));
    for (const double side : {1.0, -1.0}) {
      l.declare_zero_crossing(
          {.name = side > 0.0 ? "down" : "up",
           .guard = [=](const At& at) { return side * at.z[0]; },
           .reset_map = [=](const At&, Next& next) { next.set_discrete_state({-side}); },
           .direction = rises,
           .delay = delay});
    }
    l.declare_one_shot(1.0, [](const At&, Next& next) { next.set_discrete_state({1.0}); }, "kick");
  });
}

std::vector<double> executed(const Results& results, std::string_view name) {
  return results.events.times(name, EventKind::executed);
}

}  // namespace

TEST_CASE("3.11 an execution comes at the trigger plus its delay, exactly", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = delayed_ramp(0.5);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 3.75}, {.ode_solver_method = method});
  // A period of 1.5 s: up to 1, half a second on, back to 0.
  const auto triggers = results.events.times("late", EventKind::scheduled);
  REQUIRE(triggers.size() == 2);
  const auto found = executed(results, "late");
  REQUIRE(found.size() == 2);
  for (const std::size_t k : {0u, 1u}) {
    CHECK_THAT(triggers[k], WithinAbs(1.0 + 1.5 * static_cast<double>(k), 1e-8));
    CHECK(found[k] == triggers[k] + 0.5);  // a stop, no root: to the bit
  }
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.75, 1e-8));
  CHECK(results.events[0].due == found[0]);
  CHECK(results.events[1].due == found[0]);
  CHECK_THAT(results.events[1].before[0], WithinAbs(1.5, 1e-8));
  CHECK(results.events[1].after[0] == 0.0);
  CHECK(results.events.times("late") == found);  // it has its effect when it is executed
}

TEST_CASE("3.11 an execution within the step that found its trigger's cause is an exact stop",
          "[semantics]") {
  // A guard writes a number that no derivative reads, so nothing restarts the solver but the
  // trigger that follows. Constant derivatives have steps of seconds.
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("flagged", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}),
                                .ode = [](const At&) { return 1.0; },
                                .reads = Reads::continuous_state});
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_zero_crossing(
        {.name = "flag",
         .guard = [](const At& at) { return at.time - 1.0; },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({1.0, at.z[1]}); },
         .direction = rises});
    l.declare_zero_crossing(
        {.name = "late",
         .guard = [](const At& at) { return at.z[0] - 0.5; },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({at.z[0], at.x[0]}); },
         .direction = rises,
         .delay = 0.1});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 9.0}, {.ode_solver_method = method});
  REQUIRE(executed(results, "late").size() == 1);
  CHECK_THAT(executed(results, "late")[0], WithinAbs(1.1, 1e-12));
  CHECK_THAT(results.context.discrete_state()[1], WithinAbs(1.1, 1e-8));
}

TEST_CASE("3.11 scheduling changes no value: no j, no row", "[semantics]") {
  const Leaf leaf = delayed_ramp(0.5);
  const auto port = leaf.output(0);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.4}, {.recorded_signals = {{"x", port}}});
  REQUIRE(results.events.size() == 1);
  CHECK(results.events[0].kind == EventKind::scheduled);
  CHECK(results.events[0].jump == 0);
  CHECK(std::ranges::all_of(results.jump, [](int j) { return j == 0; }));
  CHECK(std::ranges::adjacent_find(results.time) == results.time.end());
}

TEST_CASE("3.11 a delay is a function of the values that the reset map would see", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // Before `late`, in declaration order, a plain reset map of the leaf writes z = 0.25.
  const Leaf leaf("ramp", [](Leaf& l) {
    declare_plain(l, [](const At&, Next& next) { next.set_discrete_state({0.25}); });
    l.declare_zero_crossing(
        {.name = "late",
         .guard = beyond_one,
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = rises,
         .delay = [](const At& at) { return at.x[0] + at.z[0]; }});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 3.0}, {.ode_solver_method = method});
  REQUIRE(executed(results, "late").size() == 1);
  CHECK_THAT(executed(results, "late")[0], WithinAbs(2.25, 1e-8));
}

TEST_CASE("3.11 a delay that is negative or not finite is an error with block and time",
          "[semantics]") {
  for (const double bad : {-0.5, infinite, not_a_number}) {
    const Leaf leaf = delayed_ramp([=](const At&) { return bad; });
    const std::string found =
        message<SimulationError>([&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}); });
    INFO(found);
    CHECK(contains(found, "the delay of 'ramp.late' is"));
    CHECK(contains(found, "t = 1"));
    CHECK(contains(found, "expected a finite time >= 0 s"));
  }
}

TEST_CASE("3.11 one declaration queues the executions of many triggers at once", "[semantics]") {
  // Triggers at 0.5, 1.5, 2.5 and so on. Each execution is 2.5 s behind, so three wait together.
  const Leaf leaf("clock", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({1.0 - at.z[0], at.z[1]}); }, 0.5);
    l.declare_zero_crossing(
        {.name = "echo",
         .guard = [](const At& at) { return at.z[0] - 0.5; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({at.z[0], at.z[1] + 1.0}); },
         .direction = rises,
         .delay = 2.5});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.25, 6.75});
  CHECK(executed(results, "echo") == std::vector{3.0, 4.0, 5.0, 6.0});
  CHECK(results.events.times("echo", EventKind::scheduled) ==
        std::vector{0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5});
  CHECK(results.context.discrete_state()[1] == 4.0);
}

TEST_CASE("3.13 an execution sets off others at the same time, each in a pass of its own",
          "[semantics]") {
  const int n = 20;
  // z[i] = 1 triggers event i, which makes z[i + 1] = 1. Every one is declared before the one that
  // sets it off, so no order of declarations helps.
  const Leaf leaf("row", [=](Leaf& l) {
    l.declare_discrete_state(Eigen::VectorXd::Zero(n + 1));
    for (int i = n - 1; i >= 0; --i) {
      l.declare_zero_crossing({.name = text("e", i),
                               .guard = [=](const At& at) { return at.z[i] - 0.5; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     next.set_discrete_state(
                                         at.z + Eigen::VectorXd::Unit(at.z.size(), i + 1));
                                   },
                               .direction = rises,
                               .delay = 0});
    }
    l.declare_one_shot(1.0, count_up, "push");
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0});
  CHECK(results.context.discrete_state() == Eigen::VectorXd::Ones(n + 1));
  int j = 1;  // of the push
  for (int i = 0; i < n; ++i) {
    CHECK(executed(results, text("e", i)) == std::vector{1.0});
    for (std::size_t k = 0; k < results.events.size(); ++k) {
      const Event event = results.events[k];
      if (event.name == text("e", i) && event.kind == EventKind::executed) CHECK(event.jump == ++j);
    }
  }
}

TEST_CASE("3.13 executions that set each other off without end are an error with their names",
          "[semantics]") {
  const Leaf leaf = pair(0.0);
  const std::string found =
      message<SimulationError>([&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}); });
  INFO(found);
  CHECK(contains(found, "t = 1 s: this instant does not come to an end: more than 100 passes"));
  CHECK(contains(found, "'pair.up' -> 'pair.down' -> 'pair.up'"));
}

TEST_CASE("4.7 executions that set each other off after a delay too short for the time chatter",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double delay = GENERATE(1e-15, 1e-12);  // the second: no state moves by its tolerance
  INFO("method " << method << ", " << delay << " s");
  const Leaf leaf = pair(delay);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 9.0},
               {.ode_solver_method = method, .max_major_steps = 100'000, .throw_errors = false});
  CHECK(results.status == Status::chattering);
  INFO(results.message);
  CHECK(contains(results.message, "executions, or deliveries, follow each other"));
  CHECK(contains(results.message, "Give it a longer delay"));
}

TEST_CASE("4.7 executions in quick succession that nothing sets off do not chatter",
          "[semantics]") {
  // Two thousand triggers at 1 s; each delay is one rounding longer.
  constexpr int n = 2000;
  const Leaf leaf("many", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "each",
         .guard = [](const At& at, VectorRef out) { out.setConstant(at.x[0] - 1.0); },
         .reset_map = count_up,
         .direction = rises,
         .size = n,
         .delay = [](const At& at) { return 1.0 + static_cast<double>(at.entry) * 1e-14; }});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 3.0});
  CHECK(results.context.discrete_state()[0] == n);
}

TEST_CASE("3.13 executions that are due at once are no chain, however many there are",
          "[semantics]") {
  constexpr int n = 300;
  const Leaf leaf("many", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "each",
         .guard = [](const At& at, VectorRef out) { out.setConstant(at.x[0] - 1.0); },
         .reset_map = count_up,
         .direction = rises,
         .size = n,
         .delay = 0.0});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0});
  CHECK(results.context.discrete_state()[0] == n);
  CHECK(count(results.events, EventKind::executed) == n);
}

TEST_CASE("4.7 executions at a nanosecond from each other chatter if no state moves meanwhile",
          "[semantics]") {
  const auto status = [](double rate) {
    const Leaf leaf = pair(1e-9, rate);
    return simulate(leaf, leaf.create_context(), {0.0, 10.0},
                    {.ode_solver_method = Method::dopri5,
                     .max_major_steps = 1'100'000,
                     .record_events = false,
                     .throw_errors = false})
        .status;
  };
  CHECK(status(0.0) == Status::chattering);
  CHECK(status(1.0) == Status::step_limit);  // the state moves by 1e-3 meanwhile
}
