// Instant: which values the reset maps of a pass read, what a pass sets off, and how it ends.
#include "saltus/simulation/detail/instant.hpp"

#include "support/instants.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A state that a crossing at x = 1 sets to the value of the input.
std::shared_ptr<Leaf> taker(const char* name) {
  return std::make_shared<Leaf>(name, [](Leaf& l) {
    declare_ramp(l);
    l.declare_input_port({.name = "other"});
    l.declare_zero_crossing(
        {.name = "take",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state({at.u(0)}); }});
  });
}

/// A ramp that adds `by` to its state at each of `levels`, whose crossings are declared in order.
std::shared_ptr<Leaf> stairs(const std::vector<double>& levels, double by) {
  return std::make_shared<Leaf>("stairs", [&](Leaf& l) {
    declare_ramp(l);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double level = levels[i];
      l.declare_zero_crossing(
          {.name = text("at_", i),
           .guard = [level](const At& at) { return at.x[0] - level; },
           .reset_map = [by](const At& at,
                             Next& next) { next.set_continuous_state({at.x[0] + by}); }});
    }
  });
}

}  // namespace

TEST_CASE("across leaves every reset map reads the state before the pass: two values swap",
          "[instant]") {
  DiagramBuilder builder;
  const auto one = taker("one"), two = taker("two");
  builder.add(one), builder.add(two);
  builder.connect(one->output(0), two->input(0)), builder.connect(two->output(0), one->input(0));
  Instants run(std::make_shared<Diagram>(builder.build()));
  run.begin(0.0, vec({0.0, 2.0}));
  const Outcome outcome = run.fire(1.0, vec({1.0, 1.0 + 1e-9}), {{1, 1}, {0, -1}});
  CHECK(run.machine.x == vec({1.0 + 1e-9, 1.0}));
  CHECK(outcome.restart);
  CHECK(run.instant.jump() == 1);
  CHECK(run.results.events[0].block == "one");  // in the order of the leaves
}

TEST_CASE("within a leaf the reset maps run in declaration order", "[instant]") {
  Instants run(std::make_shared<Leaf>("leaf", [](Leaf& l) {
    declare_ramp(l);
    const auto guard = [](const At& at) { return at.x[0] - 1.0; };
    l.declare_zero_crossing(
        {.name = "double", .guard = guard, .reset_map = [](const At& at, Next& next) {
           next.set_continuous_state({2.0 * at.x[0]});
         }});
    l.declare_zero_crossing(
        {.name = "add", .guard = guard, .reset_map = [](const At& at, Next& next) {
           next.set_continuous_state({at.x[0] + 1.0});
         }});
  }));
  run.begin(0.0, vec({0.0}));
  run.fire(1.0, vec({1.0}), {{0, -1}, {1, -1}});
  CHECK(run.machine.x[0] == 3.0);
  CHECK(run.results.events[0].name == "double");
  CHECK(run.results.events[1].name == "add");
}

TEST_CASE("a guard that a commit moves across zero fires in the next pass, at the same time",
          "[instant]") {
  Instants run(stairs({1.0, 1.5, 9.0}, 1.0));
  run.begin(0.0, vec({0.0}));
  run.fire(2.0, vec({1.0}), 0, -1);
  CHECK(run.machine.x[0] == 3.0);
  REQUIRE(run.results.events.size() == 2);
  CHECK(run.results.events[0].time == run.results.events[1].time);
  CHECK(run.results.events[1].name == "at_1");
  CHECK(run.results.events[0].jump == 1);
  CHECK(run.results.events[1].jump == 2);
  CHECK(run.instant.jump() == 2);
}

TEST_CASE("passes that set each other off without end are an error with their causes",
          "[instant]") {
  // Two walls that throw a point beyond each other.
  Instants run(
      std::make_shared<Leaf>("walls",
                             [](Leaf& l) {
                               declare_ramp(l);
                               for (const double level : {1.0, -1.0}) {
                                 l.declare_zero_crossing(
                                     {.name = level > 0.0 ? "right" : "left",
                                      .guard = [level](const At& at) { return at.x[0] - level; },
                                      .reset_map =
                                          [level](const At&, Next& next) {
                                            next.set_continuous_state({-3.0 * level});
                                          }});
                               }
                             }),
      {.max_passes = 20});
  run.begin(0.0, vec({0.0}));
  const auto error = message<SimulationError>([&] { run.fire(2.0, vec({1.0}), 0, -1); });
  CHECK(contains(error, "more than 20 passes"));
  CHECK(run.instant.jump() == 20);
  CHECK(contains(error, "'walls.left' -> 'walls.right' -> 'walls.left'"));
}

TEST_CASE("a crossing without an effect is an event, and changes nothing", "[instant]") {
  Instants run(std::make_shared<Leaf>("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "seen",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .terminal = true,
                             .max_count = 2});
  }));
  run.begin(0.0, vec({0.0}));
  const Outcome first = run.fire(1.0, vec({1.0}), 0, -1);
  CHECK_FALSE(first.restart);
  CHECK_FALSE(first.terminal);
  CHECK(first.events == 1);
  CHECK(run.instant.jump() == 0);
  CHECK(run.fire(2.0, vec({1.0}), 0, 1).terminal);  // its second firing
}

TEST_CASE("after an instant all guards have the side of their values", "[instant]") {
  Instants run(stairs({1.0, 2.0, 5.0}, 3.0));
  run.begin(0.0, vec({0.0}));
  for (std::size_t k = 0; k < 3; ++k) CHECK(run.guards[k].side == -1);
  run.fire(1.0, vec({1.0}), 0, -1);  // to 4, and so across 2 to 7, across 5 to 10
  CHECK(run.machine.x[0] == 10.0);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(run.guards[k].side == 1);
    CHECK(run.guards.g[k] == 10.0 - (k == 0 ? 1.0 : k == 1 ? 2.0 : 5.0));
  }
}

TEST_CASE("a guard of another mode neither fires nor keeps a side", "[instant]") {
  Instants run(std::make_shared<Leaf>("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_default_mode(0);
    l.declare_zero_crossing({.name = "leave",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "back",
                             .guard = [](const At& at) { return at.x[0] - 2.0; },
                             .start_mode = 1,
                             .end_mode = 0});
  }));
  run.begin(0.0, vec({0.0}));
  CHECK(run.guards.active().all == std::vector<std::size_t>{0});
  CHECK(run.fire(1.0, vec({1.0}), 0, -1).restart);
  CHECK(run.machine.modes[0] == 1);
  CHECK(run.guards.active().all == std::vector<std::size_t>{1});
  CHECK(run.guards[1].side == -1);
}
