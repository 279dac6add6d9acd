// Semantics 3.12: the order of the executions that are due at one time.
#include <map>
#include <set>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr auto rises = Direction::negative_then_non_negative;

/// At 1 s the events of a leaf trigger together; z[0] counts executions.
struct Queued {
  std::string name;
  std::optional<NumberOf> priority;
  NumberOf delay = 0.0;
  ResetMap reset_map = count_up;
};
Leaf together(const std::vector<Queued>& events) {
  return Leaf("leaf", [&](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (const Queued& each : events) {
      l.declare_zero_crossing({.name = each.name,
                               .guard = [](const At& at) { return at.x[0] - 1.0; },
                               .reset_map = each.reset_map,
                               .direction = rises,
                               .delay = each.delay,
                               .priority = each.priority});
    }
  });
}

/// The names of the executions, in their order.
std::vector<std::string> order(const System& system, const SimulatorOptions& options = {}) {
  const auto results = simulate(system, system.create_context(), {0.0, 3.0}, options);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < results.events.size(); ++i)
    if (results.events[i].kind == EventKind::executed) names.emplace_back(results.events[i].name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("3.12 the execution of the highest priority comes first", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double delay = GENERATE(0.0, 0.5);
  INFO("method " << method << ", delay " << delay);
  const Leaf leaf = together(
      {{"low", -1.0, delay}, {"high", 5.0, delay}, {"none", {}, delay}, {"middle", 2.0, delay}});
  CHECK(order(leaf, {.ode_solver_method = method}) == Names{"high", "middle", "low", "none"});
}

TEST_CASE("3.12 priorities are evaluated anew after each execution", "[semantics]") {
  // `first` sets z to 1, which turns the order of the two others round.
  const Leaf leaf = together({{"first", 100.0},
                              {"a", [](const At& at) { return at.z[0] > 0.0 ? 1.0 : 9.0; }},
                              {"b", 5.0}});
  CHECK(order(leaf) == Names{"first", "b", "a"});
}

TEST_CASE("3.12 plain reset maps and updates come before all executions", "[semantics]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0, 0.0, 0.0}));
    l.declare_one_shot(
        1.0, [](const At& at, Next& next) { next.set_discrete_state({1.0, at.z[1], at.z[2]}); });
    const auto guard = [](const At& at) { return at.z[0] - 0.5; };
    // Each writes how much of the others it has seen.
    l.declare_zero_crossing({.name = "queued",
                             .guard = guard,
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_discrete_state({at.z[0], at.z[1], 10.0 + at.z[1]});
                                 },
                             .direction = rises,
                             .priority = 1e300});
    l.declare_zero_crossing({.name = "plain",
                             .guard = guard,
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_discrete_state({at.z[0], 1.0 + at.z[2], at.z[2]});
                                 },
                             .direction = rises});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0});
  CHECK(results.context.discrete_state() == vec({1.0, 1.0, 11.0}));
}

TEST_CASE("3.12 executions that are due from other triggers join those of the instant",
          "[semantics]") {
  // `early` triggers at 1 s for 2 s, `now` at 2 s; at 2 s the priorities decide.
  const bool early_first = GENERATE(true, false);
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(1.0, count_up, "one");
    l.declare_one_shot(2.0, count_up, "two");
    l.declare_zero_crossing({.name = "early",
                             .guard = [](const At& at) { return at.z[0] - 0.5; },
                             .reset_map = [](const At&, Next& next) { next.set_mode(1); },
                             .direction = rises,
                             .delay = 1.0,
                             .priority = early_first ? 2.0 : 0.0});
    l.declare_zero_crossing({.name = "now",
                             .guard = [](const At& at) { return at.z[0] - 1.5; },
                             .reset_map = [](const At&, Next& next) { next.set_mode(2); },
                             .direction = rises,
                             .priority = 1.0});
  });
  CHECK(order(leaf) == (early_first ? Names{"early", "now"} : Names{"now", "early"}));
}

TEST_CASE("3.12 equal priorities come in a random order, each first in half of the runs",
          "[semantics]") {
  const std::optional<NumberOf> priority =
      GENERATE(std::optional<NumberOf>{}, std::optional<NumberOf>{3.0});
  const Leaf leaf = together({{"a", priority}, {"b", priority}});
  constexpr int runs = 1000;
  int first = 0;
  for (int seed = 0; seed < runs; ++seed)
    first += order(leaf, {.event_seed = static_cast<double>(seed)}).front() == "a";
  // Four standard deviations of a fair coin: 4 sqrt(1000) / 2 = 63.
  CHECK(std::abs(first - runs / 2) <= 63);
}

TEST_CASE("3.12 all orders of three occur, equally often", "[semantics]") {
  const Leaf leaf = together({{"a", {}}, {"b", {}}, {"c", {}}});
  std::map<Names, int> seen;
  constexpr int runs = 1200;
  for (int seed = 0; seed < runs; ++seed)
    ++seen[order(leaf, {.event_seed = static_cast<double>(seed)})];
  CHECK(seen.size() == 6);
  // Four standard deviations of 1200 draws with probability 1/6: 4 sqrt(1200 * 5 / 36) = 52.
  for (const auto& [names, times] : seen) CHECK(std::abs(times - runs / 6) <= 52);
}

TEST_CASE("3.12 one seed has one order, and the next tie of a run another draw", "[semantics]") {
  const Leaf leaf = together({{"a", {}}, {"b", {}}, {"c", {}}, {"d", {}}});
  CHECK(order(leaf, {.event_seed = 7.0}) == order(leaf, {.event_seed = 7.0}));
  // Ten ties in one run: were they one draw, the same would come first ten times.
  const Leaf again("again", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({1.0 - at.z[0]}); }, 0.5, 0.5);
    for (const char* name : {"a", "b"}) {
      l.declare_zero_crossing({.name = name,
                               .guard = [](const At& at) { return at.z[0] - 0.5; },
                               .reset_map = [](const At&, Next& next) { next.set_mode(0); },
                               .direction = rises,
                               .delay = 0.0});
    }
  });
  const auto results = simulate(again, again.create_context(), {0.0, 10.25});
  std::set<std::string> first;
  double t = -1.0;
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const Event event = results.events[i];
    if (event.kind != EventKind::executed || event.time == t) continue;
    first.emplace(event.name), t = event.time;
  }
  CHECK(first.size() == 2);
}

TEST_CASE("3.12 a priority that is not a number is an error with block and time", "[semantics]") {
  const bool alone = GENERATE(true, false);
  std::vector<Queued> events{{"a", [](const At&) { return not_a_number; }}};
  if (!alone) events.push_back({"b", 1.0});
  const Leaf leaf = together(events);
  const std::string found =
      message<SimulationError>([&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}); });
  CHECK(contains(found, "the priority of 'leaf.a' is not a number"));
  CHECK(contains(found, "t = 1"));
}

TEST_CASE("3.14 an execution that is cancelled is asked for no priority", "[semantics]") {
  // The guard goes back by an update that is due with the execution.
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(2.0, [](const At&, Next& next) { next.set_continuous_state({0.0}); });
    l.declare_zero_crossing({.name = "back",
                             .guard = [](const At& at) { return at.x[0] - 1.5; },
                             .reset_map = count_up,
                             .direction = rises,
                             .delay = 0.5,
                             .priority = [](const At&) { return not_a_number; },
                             .persistent = false});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.25});
  CHECK(results.context.discrete_state()[0] == 0.0);
}
