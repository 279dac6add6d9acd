// Semantics 5.6b: a context carries the executions that wait.
#include "saltus/model/context_json.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr auto rises = Direction::negative_then_non_negative;

/// Every second four events trigger. They are executed 2.25 s later in a random order; each
/// appends its number to a hash of all before it, in z[1]. No state moves, so a split run has the
/// same times and the same bits.
Leaf hashing(bool early = false) {
  return Leaf("leaf", [=](Leaf& l) {
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({1.0 - at.z[0], at.z[1]}); }, 0.5);
    for (int k = 1; k <= 4; ++k) {
      l.declare_zero_crossing({.name = text("e", k),
                               .guard = [](const At& at) { return at.z[0] - 0.5; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     next.set_discrete_state(
                                         {at.z[0], std::fmod(7.0 * at.z[1] + k, 1e6)});
                                   },
                               .direction = rises,
                               .delay = 2.25,
                               .use_values_from_trigger_time = early});
    }
  });
}

struct Ran {
  std::vector<std::pair<double, std::string>> events;  // time, kind and name
  Context context;
};
template <class Pass>
Ran run(const System& system, const std::vector<double>& stops, const Pass& pass) {
  Ran ran{{}, system.create_context().with_time(0.25)};
  for (const double stop : stops) {
    const auto results = simulate(system, ran.context, {ran.context.time(), stop});
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      const Event event = results.events[i];
      ran.events.emplace_back(event.time, text(to_string(event.kind), " ", event.name));
    }
    ran.context = pass(results.context);
  }
  return ran;
}
Context same(const Context& context) { return context; }

}  // namespace

TEST_CASE("5.6b a run in pieces has the executions of the unbroken run, in the same order",
          "[semantics]") {
  const bool early = GENERATE(true, false);
  const Leaf leaf = hashing(early);
  const auto json = [&](const Context& context) {
    return context_from_json(leaf, to_json(context));
  };
  const Ran whole = run(leaf, {20.0}, same);
  // Stops between triggers, at a trigger, and at executions.
  const std::vector<double> stops{2.0, 2.1, 3.25, 5.0, 5.25, 5.3, 11.0, 20.0};
  for (const Ran& split : {run(leaf, stops, same), run(leaf, stops, json)}) {
    CHECK(split.events == whole.events);
    CHECK(split.context.discrete_state() == whole.context.discrete_state());
    REQUIRE(split.context.pending() != nullptr);
    CHECK(*split.context.pending() == *whole.context.pending());
  }
}

TEST_CASE("5.6b values of the trigger time wait in the context", "[semantics]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "late",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state(-at.x); },
         .direction = rises,
         .delay = 1.0,
         .use_values_from_trigger_time = true});
  });
  const auto first = simulate(leaf, leaf.create_context(), {0.0, 1.5});
  REQUIRE(first.context.pending() != nullptr);
  const PendingExecution& waits = first.context.pending()->all.at(0);
  CHECK(waits.values.continuous_entries == std::vector{0});
  const double value = waits.values.continuous.at(0);
  const auto second = simulate(leaf, first.context, {1.5, waits.due});
  CHECK(second.context.continuous_state()[0] == value);
}

TEST_CASE("5.6b a context that is changed by hand keeps what waits, and when", "[semantics]") {
  const Leaf leaf = hashing();
  const auto first = simulate(leaf, leaf.create_context().with_time(0.25), {0.25, 2.5});
  const Context changed = first.context.with_discrete_state({1.0, 0.0});
  REQUIRE(changed.pending() != nullptr);
  CHECK(changed.pending()->all == first.context.pending()->all);
  const auto second = simulate(leaf, changed, {2.5, 3.5});
  CHECK(count(second.events, EventKind::executed) == 4);  // at 2.75, from the triggers at 0.5
  CHECK(second.events.times("e1", EventKind::executed) == std::vector{2.75});
}

TEST_CASE("5.6b an execution whose time is past happens at the start", "[semantics]") {
  const Leaf leaf = hashing();
  const auto first = simulate(leaf, leaf.create_context().with_time(0.25), {0.25, 1.25});
  const auto second = simulate(leaf, first.context.with_time(8.25), {8.25, 8.4});
  CHECK(second.events.times("e1", EventKind::executed) == std::vector{8.25});
}

TEST_CASE("5.6b an instant that fails leaves what waited before it", "[semantics]") {
  bool bad = true;
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(1.0, count_up, "on");
    for (const bool first : {true, false}) {
      l.declare_zero_crossing({.name = first ? "first" : "second",
                               .guard = [](const At& at) { return at.z[0] - 0.5; },
                               .reset_map =
                                   [&bad, first](const At& at, Next& next) {
                                     if (!first && bad) throw std::runtime_error("not now");
                                     count_up(at, next);
                                   },
                               .direction = rises,
                               .delay = 1.0,
                               .priority = first ? 2.0 : 1.0});
    }
  });
  const auto failed = simulate(leaf, leaf.create_context(), {0.0, 3.0}, {.throw_errors = false});
  CHECK(failed.status == Status::failed);
  CHECK(failed.context.time() == 2.0);
  REQUIRE(failed.context.pending() != nullptr);
  CHECK(failed.context.pending()->all.size() == 2);  // the first was taken back
  bad = false;
  const auto resumed = simulate(leaf, failed.context, {2.0, 3.0});
  CHECK(resumed.context.discrete_state()[0] == 3.0);
  CHECK(count(resumed.events, EventKind::executed) == 2);
}

TEST_CASE("5.6b pending executions that no run can have left are refused", "[semantics]") {
  const Leaf leaf = hashing(true),
             other("leaf", [](Leaf& l) { l.declare_discrete_state(vec({0.0, 0.0})); });
  const Context good = simulate(leaf, leaf.create_context().with_time(0.25), {0.25, 2.0}).context;
  const auto changed = [&](const auto& change) {
    ContextValues values = good.values();
    auto pending = std::make_shared<PendingExecutions>(*values.pending);
    change(*pending);
    values.pending = pending;
    return message<ModelError>([&] { good.with_values(values); });
  };
  CHECK(changed([](PendingExecutions&) {}) == "no exception");
  const auto refused = [&](const auto& change) { return contains(changed(change), "is damaged"); };
  CHECK(refused([](PendingExecutions& p) { p.all[0].leaf = 1; }));
  CHECK(refused([](PendingExecutions& p) { p.all[0].event = -1; }));
  CHECK(refused([](PendingExecutions& p) { p.all[0].due = infinite; }));
  CHECK(refused([](PendingExecutions& p) { p.all[0].due = 1e9; }));
  CHECK(refused([](PendingExecutions& p) { p.scheduled = 0; }));
  CHECK(refused([](PendingExecutions& p) { p.draws = -1; }));
  CHECK(refused([](PendingExecutions& p) { p.all[0].values.discrete_entries = {7}; }));
  CHECK(refused([](PendingExecutions& p) { p.all[0].values.discrete.push_back(1.0); }));
  CHECK(refused([](PendingExecutions& p) { p.all[0].values.discrete[0] = not_a_number; }));
  // A sound context of a system that has the same states and no such zero crossing.
  const std::string found = message<ModelError>([&] { simulate(other, good, {good.time(), 3.0}); });
  CHECK(contains(found, "which has no such queued zero crossing"));
}
