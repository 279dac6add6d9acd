// Journal: names and counts of events, the chain of causes, the event log.
#include "saltus/simulation/detail/journal.hpp"

#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

void write(const At& at, Next& next) { next.set_continuous_state({at.x[0]}); }

/// A leaf with two zero crossings, one of them terminal at its third firing, an edge reset and a
/// periodic update; its input is a constant.
Diagram sources() {
  const auto leaf = std::make_shared<Leaf>("leaf", [](Leaf& l) {
    declare_ramp(l, 1.0, 0.5);
    const int input = l.declare_input_port({.name = "switch"});
    const auto guard = [](const At& at) { return at.x[0]; };
    l.declare_zero_crossing({.name = "wall", .guard = guard, .reset_map = &write});
    l.declare_zero_crossing({.name = "last", .guard = guard, .terminal = true, .max_count = 3});
    l.declare_zero_crossing({.name = "never", .guard = guard, .direction = Direction::none});
    l.declare_edge_reset({.name = "flank", .input = input, .reset_map = &write});
    l.declare_periodic_update([](const At&, Next&) {}, 1.0, 0.5, "tick");
  });
  DiagramBuilder builder;
  builder.add(leaf);
  auto& off = builder.add<Constant>("off", 0.0);
  builder.connect(off.output(), leaf->input(0));
  return builder.build();
}

/// A journal in an instant at t = 2 s.
struct Events {
  explicit Events(SimulatorOptions with = {}) : options(std::move(with)) {
    machine.load(diagram.create_context());
    transition.open(), transition.begin_pass();
    journal.begin(), journal.open(2.0), journal.at_jump(4);
  }
  int source(Cause cause, int index) const { return journal.source_of(cause, index); }
  void fire(int group) {
    journal.note({.kind = EventKind::zero_crossing, .source = group, .leaf = 0, .direction = -1});
  }
  std::string no_end() {
    return message<SimulationError>([&] { journal.throw_no_end(); });
  }

  Diagram diagram = sources();
  SimulatorOptions options;
  Machine machine{compile(diagram)};
  Transition transition{machine};
  Results results;
  Journal journal{machine, transition, options, results};
};

}  // namespace

TEST_CASE("every source has its own number and its name", "[journal]") {
  const Events run;
  CHECK(run.journal.name_of(run.source(Cause::crossing, 0)) == "leaf.wall");
  CHECK(run.journal.name_of(run.source(Cause::crossing, 1)) == "leaf.last");
  CHECK(run.journal.name_of(run.source(Cause::edge, 0)) == "leaf.flank");
  CHECK(run.journal.name_of(run.source(Cause::time, 0)) == "leaf.tick");
}

TEST_CASE("an event that can never fire has a name too, and no count", "[journal]") {
  const Events run;
  CHECK(run.results.events.names() == std::vector<std::string>{"leaf.wall", "leaf.last",
                                                               "leaf.flank", "leaf.tick",
                                                               "leaf.never"});
  CHECK(run.results.events.times("never").empty());
  CHECK(run.journal.counts().empty());
}

TEST_CASE("an entry of the log has the time, the jump, and the states around it", "[journal]") {
  Events run;
  run.transition.next()[0] = 7.0;
  run.fire(0);
  REQUIRE(run.results.events.size() == 1);
  const Event event = run.results.events[0];
  CHECK(event.time == 2.0);
  CHECK(event.jump == 4);
  CHECK(event.direction == -1);
  CHECK(event.block == "leaf");
  CHECK(event.name == "wall");
  CHECK(event.before[0] == 0.5);
  CHECK(event.after[0] == 7.0);
}

TEST_CASE("the crossing of a monitor has its own time, and one state", "[journal]") {
  Events run;
  const double x = 0.25;
  Guard guard{};
  guard.group = 1, guard.entry = 3;
  run.journal.note_monitor({1.5, {1, -1}}, guard, 9, &x);
  const Event event = run.results.events[0];
  CHECK(event.time == 1.5);
  CHECK(event.jump == 9);
  CHECK(event.direction == 1);
  CHECK(event.entry == 3);
  CHECK(event.before[0] == 0.25);
  CHECK(event.after[0] == 0.25);
  CHECK(run.journal.events() == 0);  // it belongs to no instant
}

TEST_CASE("firings are counted by name; a rest and a release are no firings", "[journal]") {
  Events run;
  run.fire(0), run.fire(0);
  run.journal.note({.kind = EventKind::time, .source = run.source(Cause::time, 0), .leaf = 0});
  for (const EventKind kind : {EventKind::zeno_enter, EventKind::zeno_release})
    run.journal.note({.kind = kind, .source = 1, .leaf = 0});
  const std::vector<std::pair<std::string, std::int64_t>> expected{{"leaf.wall", 2},
                                                                   {"leaf.tick", 1}};
  CHECK(run.journal.counts() == expected);
  CHECK(run.journal.events() == 5);
  CHECK(run.results.statistics.events == 5);
  CHECK(run.journal.last_event().full() == "leaf.last");
}

TEST_CASE("the events of an instant are counted anew, those of the run go on", "[journal]") {
  Events run;
  run.fire(0);
  run.journal.open(3.0), run.fire(0);
  CHECK(run.journal.events() == 1);
  CHECK(run.journal.counts()[0].second == 2);
  CHECK(run.results.events[1].time == 3.0);
  run.journal.begin();
  CHECK(run.journal.counts().empty());
  CHECK(run.journal.last_event().event.empty());
  CHECK(run.results.events.empty());
}

TEST_CASE("undo takes back the events of an instant, and no earlier one", "[journal]") {
  Events run;
  run.fire(0), run.fire(1);
  const double x = 0.0;
  Guard guard{};
  guard.group = 1;
  run.journal.note_monitor({2.5, {1, -1}}, guard, 4, &x);  // between two instants
  run.journal.open(3.0);
  run.fire(0), run.fire(0);
  run.journal.note({.kind = EventKind::zeno_enter, .source = 0, .leaf = 0});
  run.journal.undo();
  const std::vector<std::pair<std::string, std::int64_t>> expected{{"leaf.wall", 1},
                                                                   {"leaf.last", 2}};
  CHECK(run.journal.counts() == expected);
  CHECK(run.results.events.size() == 3);
  CHECK(run.results.statistics.events == 2);
  run.journal.open(3.0), run.fire(0);  // the instant again
  CHECK(run.journal.counts()[0].second == 2);
}

TEST_CASE("without a log the events are counted all the same", "[journal]") {
  Events run({.record_events = false});
  run.fire(0);
  CHECK(run.results.events.empty());
  CHECK(run.journal.counts()[0].second == 1);
}

TEST_CASE("a terminal guard ends the run at its last firing, earlier runs included", "[journal]") {
  Events run;
  CHECK_FALSE(run.journal.ends_run(0));  // not terminal
  run.fire(1);
  CHECK_FALSE(run.journal.ends_run(1));
  run.fire(1);
  CHECK(run.journal.ends_run(1));

  Events first, second;
  first.fire(1);
  const Continuation between{.counts = first.journal.save()};
  REQUIRE(second.journal.fits(between));
  second.journal.load(between);
  CHECK_FALSE(second.journal.ends_run(1));
  second.fire(1);
  CHECK(second.journal.ends_run(1));
  CHECK(second.journal.save() == std::vector<std::int64_t>{0, 2});
  CHECK(second.journal.counts()[0].second == 1);  // of this run only
  CHECK_FALSE(second.journal.fits({.counts = {1}}));
}

TEST_CASE("an instant without end names its last six causes and the block of the last",
          "[journal]") {
  Events run;
  for (const int source : {0, 1, 1, 1, 1, 1}) run.journal.cause(source);
  run.journal.cause(run.source(Cause::edge, 0)), run.journal.cause(run.source(Cause::time, 0));
  CHECK(run.no_end() ==
        "t = 2 s: this instant does not come to an end: more than 100 passes; the events set each "
        "other off: ... 'leaf.last' -> 'leaf.last' -> 'leaf.last' -> 'leaf.last' -> 'leaf.flank' "
        "-> 'leaf.tick' ...; break the loop, or raise max_passes");
  try {
    run.journal.throw_no_end();
  } catch (const SimulationError& error) {
    CHECK(error.block() == "leaf");
  }
}

TEST_CASE("a chain remembers its first four hundred causes, and begins anew with an instant",
          "[journal]") {
  Events run;
  for (int i = 0; i < 399; ++i) run.journal.cause(0);
  run.journal.cause(1);
  CHECK(contains(run.no_end(), "leaf.last"));
  run.journal.open(2.0);
  for (int i = 0; i < 400; ++i) run.journal.cause(0);
  run.journal.cause(1);
  CHECK_FALSE(contains(run.no_end(), "leaf.last"));
  run.journal.open(2.0), run.journal.cause(1);
  CHECK(contains(run.no_end(), "... 'leaf.last' ..."));
  CHECK_FALSE(contains(run.no_end(), "leaf.wall"));
}
