// Laws of queued zero crossings: a delayed relay has a period in closed form; a trigger over
// several comparisons; ten thousand that wait; and what a scene without them does not pay.
#include <cmath>

#include "saltus/plan/compile.hpp"
#include "saltus/simulation/detail/instant.hpp"
#include "support/allocations.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr auto rises = Direction::negative_then_non_negative;
constexpr auto falls = Direction::positive_then_non_positive;

/// Triggers at the odd milliseconds, n of them; each is executed `delay` [s] later.
Leaf echoes(double delay) {
  return Leaf("leaf", [=](Leaf& l) {
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({1.0 - at.z[0], at.z[1]}); }, 1e-3,
        1e-3);
    l.declare_zero_crossing(
        {.name = "echo",
         .guard = [](const At& at) { return at.z[0] - 0.5; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({at.z[0], at.z[1] + 1.0}); },
         .direction = rises,
         .delay = delay});
  });
}

}  // namespace

TEST_CASE("a relay that switches late by d overshoots by d, and has the period 4 (h + d)",
          "[laws][queue]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  constexpr double h = 0.5, d = 0.125;
  // x' = m; at +h the mode becomes -1, at -h it becomes +1, each after d.
  const Leaf leaf("relay", [=](Leaf& l) {
    l.declare_default_mode(1);
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return static_cast<double>(at.mode); }});
    l.declare_zero_crossing({.name = "top",
                             .guard = [=](const At& at) { return at.x[0] - h; },
                             .direction = rises,
                             .end_mode = -1,
                             .delay = d});
    l.declare_zero_crossing({.name = "bottom",
                             .guard = [=](const At& at) { return at.x[0] + h; },
                             .direction = falls,
                             .end_mode = 1,
                             .delay = d});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  const auto tops = results.events.times("top", EventKind::executed);
  REQUIRE(tops.size() == 8);
  // Straight lines: each location is exact to some roundings of the time.
  for (std::size_t k = 0; k < tops.size(); ++k)
    CHECK_THAT(tops[k], WithinAbs((h + d) + 4.0 * (h + d) * static_cast<double>(k), 1e-10));
}

TEST_CASE("a neuron with a queued reset fires once a second, as with a plain one",
          "[laws][queue]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // x' = 1, from 1 back to 0: every step after a reset spans many periods.
  const Leaf leaf("neuron", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "spike",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = rises,
         .priority = 1.0});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 100.5}, {.ode_solver_method = method});
  const auto spikes = results.events.times("spike");
  REQUIRE(spikes.size() == 100);
  for (std::size_t k = 0; k < spikes.size(); ++k)
    CHECK_THAT(spikes[k], WithinAbs(static_cast<double>(k) + 1.0, 1e-8));
}

TEST_CASE("a ball with a queued bounce does not fall through its floor: the run says chattering",
          "[laws][queue]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.5);
  INFO("method " << method << ", e " << e);
  const Leaf ball("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81; }});
    l.declare_zero_crossing({.name = "bounce",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   next.set_continuous_state({std::abs(at.x[0]), -e * at.x[1]});
                                 },
                             .direction = falls,
                             .priority = 1.0});
  });
  const auto results = simulate(ball, ball.create_context(), {0.0, 6.0},
                                {.ode_solver_method = method, .throw_errors = false});
  CHECK(results.status == Status::chattering);
  CHECK(results.context.continuous_state()[0] > -1e-6);  // the absolute tolerance is 1e-8
}

TEST_CASE("a trigger over and, or and not of comparisons is located by their zeros",
          "[laws][queue]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // x = t. The truth is (x > 1 and not x > 2) or x > 3: it rises at 1 and at 3.
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    std::vector<RelationIndex> above;
    for (const double level : {1.0, 2.0, 3.0})
      above.push_back(l.declare_relation(
          {.name = text("above ", level), .guard = [=](const At& at) { return at.x[0] - level; }}));
    l.declare_zero_crossing({.name = "true",
                             .guard =
                                 [=](const At& at) {
                                   const bool in = at.relation(above[0]) && !at.relation(above[1]);
                                   return in || at.relation(above[2]) ? 1.0 : -1.0;
                                 },
                             .reset_map = count_up,
                             .direction = rises,
                             .delay = 0.25,
                             .persistent = false});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 4.0}, {.ode_solver_method = method});
  const auto found = results.events.times("true", EventKind::executed);
  REQUIRE(found.size() == 2);
  CHECK_THAT(found[0], WithinAbs(1.25, 1e-8));
  CHECK_THAT(found[1], WithinAbs(3.25, 1e-8));
  CHECK(count(results.events, EventKind::cancelled) == 0);
}

TEST_CASE("the executions of two blocks are ordered together, and each writes its own block",
          "[laws][queue]") {
  DiagramBuilder builder;
  const auto block = [&](const std::string& name, double priority) {
    builder.add<Leaf>(name, [=](Leaf& l) {
      declare_ramp(l);
      l.declare_zero_crossing(
          {.name = "e",
           .guard = [](const At& at) { return at.x[0] - 1.0; },
           .reset_map = [=](const At&, Next& next) { next.set_continuous_state({-priority}); },
           .direction = rises,
           .priority = priority});
    });
  };
  block("a", 1.0), block("b", 3.0), block("c", 2.0);
  const Diagram diagram = builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 1.5});
  std::string order;
  for (std::size_t i = 0; i < results.events.size(); ++i)
    if (results.events[i].kind == EventKind::executed) order += results.events[i].block;
  CHECK(order == "bca");
  for (const auto& [i, priority] : {std::pair{0, 1.0}, {1, 3.0}, {2, 2.0}})
    CHECK_THAT(results.context.continuous_state()[i], WithinAbs(0.5 - priority, 1e-8));
}

TEST_CASE("ten thousand executions wait, and each comes at its time", "[laws][queue]") {
  constexpr int n = 10'000;
  const Leaf leaf = echoes(20.0);  // the first comes after the last trigger
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 20.0005});
  REQUIRE(results.context.pending() != nullptr);
  REQUIRE(results.context.pending()->all.size() == n);
  const auto rest = simulate(leaf, results.context, {20.0005, 30.0005});
  const auto found = rest.events.times("echo", EventKind::executed);
  REQUIRE(found.size() == n / 2);
  for (std::size_t k = 0; k < found.size(); ++k)
    CHECK(std::abs(found[k] - (20.001 + 2e-3 * static_cast<double>(k))) <= 1e-13);
}

TEST_CASE("an event asks for as much memory, however many executions wait", "[laws][queue]") {
  // One that waits costs two nodes of trees. Were the queue copied or sorted at each instant, the
  // bytes for each event would grow with the number that waits, here by a factor of sixteen.
  const auto bytes_of_event = [](double length) {
    const Leaf leaf = echoes(length);
    const auto start = leaf.create_context();
    const long before = allocated_bytes();
    const auto results = simulate(leaf, start, {0.0, 2.0 * length}, {.record_events = false});
    return static_cast<double>(allocated_bytes() - before) /
           static_cast<double>(results.statistics.events);
  };
  if (allocated_bytes() < 0) return;
  const double few = bytes_of_event(0.5), many = bytes_of_event(8.0);
  INFO(few << " bytes an event, then " << many);
  CHECK(many <= 1.5 * few);
}

TEST_CASE("a plan says which guards are triggers, and that one that cancels is located both ways",
          "[laws][queue]") {
  const auto describe = [](std::optional<bool> persistent) {
    const Leaf leaf("leaf", [=](Leaf& l) {
      declare_ramp(l);
      l.declare_zero_crossing({.name = "e",
                               .guard = [](const At& at) { return at.x[0]; },
                               .direction = rises,
                               .end_mode = 1,
                               .delay = 1.0,
                               .persistent = persistent});
    });
    return compile(leaf)->describe();
  };
  const std::string trigger = ", a trigger: it schedules an execution";
  CHECK(contains(describe({}), "guard 'leaf.e': negative_then_non_negative" + trigger));
  CHECK(contains(describe(false), "guard 'leaf.e': crosses_zero" + trigger));
}

TEST_CASE("a scene without queued zero crossings has no queue and no stop for it",
          "[laws][queue]") {
  const Leaf plain("plain", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "g",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = rises});
  });
  const auto results = simulate(plain, plain.create_context(), {0.0, 3.5});
  CHECK(results.context.pending() == nullptr);
  Machine machine(compile(plain));
  GuardSet guards(machine.plan());
  const SimulatorOptions options;
  Results none;
  const Instant instant(machine, guards, options, none);
  CHECK_FALSE(instant.queues().may_wait());
  CHECK(instant.queues().next_due() == nullptr);  // the calendar looks at no queue
}

TEST_CASE("a chain of executions may be as long as a chain of plain resets", "[laws][queue]") {
  // Guard k fires where z passes k - 1/2, and sets z to k: the first by time, the others one another.
  const auto ends_well = [](int links, bool queued) {
    const Leaf leaf("leaf", [=](Leaf& l) {
      declare_ramp(l);
      l.declare_discrete_state(vec({0.0}));
      for (int k = 1; k <= links; ++k) {
        ZeroCrossing link{
            .name = text("link", k),
            .guard = [k](const At& at) { return k == 1 ? at.x[0] - 1.0 : at.z[0] - (k - 1.5); },
            .reset_map = [k](const At&,
                             Next& next) { next.set_discrete_state({static_cast<double>(k)}); },
            .direction = Direction::negative_then_non_negative};
        if (queued) link.delay = 0.0;
        l.declare_zero_crossing(std::move(link));
      }
    });
    const auto results =
        simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.max_passes = 6, .throw_errors = false});
    const bool well = results.status == Status::reached_end;
    if (well) CHECK(results.context.discrete_state()[0] == links);
    return well;
  };
  for (int links = 1; links <= 8; ++links) {
    INFO(links << " links");
    CHECK(ends_well(links, true) == ends_well(links, false));
  }
  CHECK(ends_well(4, true));
  CHECK_FALSE(ends_well(8, true));
}
