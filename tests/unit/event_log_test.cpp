// EventLog: rows in, events out; names with dots; times by short and full name.
#include "saltus/simulation/event_log.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

EventLog two_rows() {
  EventLog log;
  log.begin({{"plant.ball", "bounce"}, {"clock", "tick"}});
  const double before[] = {0.0, -3.0}, after[] = {0.0, 2.0};
  log.add({.time = 1.0,
           .jump = 1,
           .direction = -1,
           .kind = EventKind::zero_crossing,
           .source = 0,
           .predicted = not_a_number,
           .states = 0,
           .width = 2},
          before, after);
  log.add({.time = 1.5,
           .jump = 2,
           .direction = 0,
           .kind = EventKind::time,
           .source = 1,
           .predicted = not_a_number,
           .states = 0,
           .width = 0},
          before, after);
  return log;
}

}  // namespace

TEST_CASE("an event has time, jump, kind, direction, block, name and states", "[event_log]") {
  const EventLog log = two_rows();
  REQUIRE(log.size() == 2);
  const Event bounce = log[0];
  CHECK((bounce.time == 1.0 && bounce.jump == 1 && bounce.direction == -1 &&
         bounce.kind == EventKind::zero_crossing));
  CHECK(bounce.block == "plant.ball");
  CHECK(bounce.name == "bounce");
  CHECK((bounce.before[1] == -3.0 && bounce.after[1] == 2.0 && bounce.before.size() == 2));
  CHECK(log[1].before.empty());
  CHECK(log[1].block == "clock");
}

TEST_CASE("times are asked for by name, full or short, and kind", "[event_log]") {
  const EventLog log = two_rows();
  CHECK(log.times("bounce") == std::vector{1.0});
  CHECK(log.times("plant.ball.bounce") == std::vector{1.0});
  CHECK(log.times("tick", EventKind::zero_crossing).empty());
  CHECK(log.times("tick", EventKind::time) == std::vector{1.5});
}

TEST_CASE("without a kind the times are those at which an event fired", "[event_log]") {
  EventLog log;
  log.begin({{"ball", "bounce"}, {"clock", "tick"}});
  double t = 0.0;
  for (const EventKind kind : {EventKind::zero_crossing, EventKind::zeno_enter,
                               EventKind::zeno_release, EventKind::terminal})
    log.add({.time = ++t,
             .jump = 1,
             .direction = -1,
             .kind = kind,
             .source = 0,
             .predicted = not_a_number,
             .states = 0,
             .width = 0},
            nullptr, nullptr);
  log.add({.time = 9.0,
           .jump = 2,
           .direction = 0,
           .kind = EventKind::time,
           .source = 1,
           .predicted = not_a_number,
           .states = 0,
           .width = 0},
          nullptr, nullptr);
  CHECK(log.times("bounce") == std::vector{1.0, 4.0});
  CHECK(log.times("tick") == std::vector{9.0});
}

TEST_CASE("a name with dots is the event of that path, or else the own name of events",
          "[event_log]") {
  EventLog log;
  log.begin({{"b", "c"}, {"x", "b.c"}, {"x", "y=0.5"}, {"z", "c"}});
  for (int source = 0; source < 4; ++source)
    log.add({.time = 1.0 + source,
             .jump = 1,
             .direction = 0,
             .kind = EventKind::zero_crossing,
             .source = source,
             .predicted = not_a_number,
             .states = 0,
             .width = 0},
            nullptr, nullptr);
  CHECK((log[1].block == "x" && log[1].name == "b.c"));
  CHECK(log.times("b.c") == std::vector{1.0});  // the path
  CHECK(log.times("x.b.c") == std::vector{2.0});
  CHECK(log.times("y=0.5") == std::vector{3.0});
  CHECK(log.times("x.y=0.5") == std::vector{3.0});
  CHECK(log.times("c") == std::vector{1.0, 4.0});
  CHECK_THROWS_AS(log.times("5"), ModelError);
}

TEST_CASE("a name that no event has is refused with the nearest one; one that never fired is not",
          "[event_log]") {
  EventLog log;
  log.begin({{"plant.ball", "bounce"}, {"plant.other", "bounce"}, {"clock", "tick"}});
  CHECK(log.times("bounce").empty());
  CHECK(log.times("clock.tick", EventKind::time).empty());
  CHECK(message<ModelError>([&] { log.times("bonce"); }) ==
        "no event is called 'bonce'; did you mean 'bounce'? Known: 'bounce', 'tick'");
  CHECK(message<ModelError>([&] { log.times("plant.bal.bounce"); }) ==
        "no event is called 'plant.bal.bounce'; did you mean 'plant.ball.bounce'? Known: "
        "'plant.ball.bounce', 'plant.other.bounce', 'clock.tick'");
  CHECK(message<ModelError>([&] { log.times("ball"); }).starts_with("no event is called 'ball'"));
  CHECK(message<ModelError>([] { EventLog().times("bounce"); }) ==
        "no event is called 'bounce'; there are none");
}

TEST_CASE("what is declared and can never fire has no times, and is no unknown name",
          "[event_log]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    const auto level = [](const At& at) { return at.x[0] - 1.0; };
    l.declare_zero_crossing({.name = "off", .guard = level, .direction = Direction::none});
    l.declare_zero_crossing({.name = "other mode", .guard = level, .start_mode = 3});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0});
  CHECK(results.events.times("off").empty());
  CHECK(results.events.times("leaf.other mode").empty());
  CHECK_THROWS_AS(results.events.times("of"), ModelError);
}

TEST_CASE("a cleared log keeps its names; an emptied copy too", "[event_log]") {
  EventLog log = two_rows();
  EventLog copy = log.emptied();
  log.clear();
  CHECK(log.empty());
  CHECK(copy.empty());
  const double x[] = {1.0};
  copy.add({.time = 2.0,
            .jump = 0,
            .direction = 0,
            .kind = EventKind::time,
            .source = 1,
            .predicted = 0.0,
            .states = 0,
            .width = 1},
           x, x);
  CHECK(copy[0].name == "tick");
}

TEST_CASE("every kind has its name", "[event_log]") {
  CHECK(to_string(EventKind::zero_crossing) == "zero_crossing");
  CHECK(to_string(EventKind::time) == "time");
  CHECK(to_string(EventKind::zeno_enter) == "zeno_enter");
  CHECK(to_string(EventKind::zeno_release) == "zeno_release");
  CHECK(to_string(EventKind::terminal) == "terminal");
}

TEST_CASE("the log of a run holds the state of the event's own block, before and after",
          "[event_log]") {
  DiagramBuilder builder;
  builder.add<Leaf>("other", [](Leaf& l) { declare_ramp(l, 5.0, 100.0); });
  builder.add<Leaf>("saw", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({-2.0}); }});
  });
  const Diagram diagram = builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0});
  REQUIRE(results.events.size() == 1);
  const Event event = results.events[0];
  REQUIRE(event.before.size() == 1);
  CHECK(std::abs(event.before[0] - 1.0) < 1e-12);
  CHECK(event.after[0] == -2.0);
  CHECK(event.jump == 1);
  CHECK(results.statistics.events == 1);
}
