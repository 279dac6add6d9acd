// Islands of a plan: which blocks are joined, by what, and what the plan of an island has.
#include "saltus/plan/islands.hpp"

#include "saltus/plan/compile.hpp"
#include "support/islands.hpp"

using namespace saltus;
using namespace support;

namespace {

using Parts = std::vector<std::vector<int>>;

Islands islands_in(const System& system, const RecordedSignals& recorded = {}) {
  return find_islands(*compile(system, recorded));
}

}  // namespace

TEST_CASE("blocks without a wire are islands, in the order of their declaration",
          "[unit][islands]") {
  const Islands found = islands_in(scene_of({0, 1, 2, 3}));
  // The Sine has neither state nor event, but the island that reads it has it.
  CHECK(found.leaves == Parts{{0}, {1}, {2}, {3, 4, 5}});
  CHECK(found.describe() == "islands: 4, which step apart\n");
}

TEST_CASE("a constant source joins nothing: each reader has a copy", "[unit][islands]") {
  DiagramBuilder builder;
  auto& floor = builder.add<Constant>("floor", 0.0);
  auto& one = builder.add<BallOnTable>(BallOptions{}, "one");
  auto& two = builder.add<BallOnTable>(BallOptions{}, "two");
  builder.connect(floor.output(), one.input(0)), builder.connect(floor.output(), two.input(0));
  CHECK(islands_in(builder.build()).leaves == Parts{{0, 1}, {0, 2}});
}

TEST_CASE("a source with time events is copied; it belongs to its first reader",
          "[unit][islands]") {
  DiagramBuilder builder;
  auto& kick = builder.add<Step>("kick", Step::Options{.step_time = 0.5});
  auto& twice = builder.add<Gain>("twice", 2.0);
  auto& one = builder.add<Integrator>("one");
  auto& two = builder.add<Integrator>("two");
  builder.add<Step>("unread", Step::Options{.step_time = 0.5});
  builder.connect(kick.output(), one.input()), builder.connect(kick.output(), twice.input());
  builder.connect(twice.output(), two.input());
  const Islands found = islands_in(builder.build());
  CHECK(found.leaves == Parts{{0, 2}, {0, 1, 3}, {4}});
  CHECK(found.of_leaf[0] == 0);
}

TEST_CASE("a source with a state that moves joins its readers", "[unit][islands]") {
  DiagramBuilder builder;
  auto& rate = builder.add<Constant>("rate", 1.0);
  auto& ramp = builder.add<Integrator>("ramp");
  auto& one = builder.add<Integrator>("one");
  auto& two = builder.add<Integrator>("two");
  builder.connect(rate.output(), ramp.input());
  builder.connect(ramp.output(), one.input()), builder.connect(ramp.output(), two.input());
  CHECK(islands_in(builder.build()).count() == 1);
}

TEST_CASE("a guard on a sum joins, and its block is named", "[unit][islands]") {
  DiagramBuilder builder;
  auto& pull = builder.add<Constant>("pull", 1.0);
  auto& one = builder.add<Integrator>("one");
  auto& two = builder.add<Integrator>("two");
  auto& other = builder.add<Integrator>("other");
  auto& total = builder.add<Adder>("total", "++");
  auto& supervisor = builder.add<Leaf>("supervisor", [](Leaf& l) {
    l.declare_input_port({.name = "total", .shape = Shape::scalar()});
    l.declare_zero_crossing({.name = "full", .guard = [](const At& at) { return at.u(0) - 1.0; }});
  });
  for (Integrator* each : {&one, &two, &other}) builder.connect(pull.output(), each->input());
  builder.connect(one.output(), total.input(0)), builder.connect(two.output(), total.input(1));
  builder.connect(total.output(), supervisor.input(0));
  const Islands found = islands_in(builder.build());
  CHECK(found.count() == 2);
  REQUIRE(found.joins.size() >= 1);
  CHECK(found.joins.front().reader == "total.out");
  CHECK(found.joins.front().parts == 2);
  CHECK(contains(found.describe(), "joined by 'total.out' (reads 2 other parts)"));
}

TEST_CASE("a recorded sum joins what it reads; unrecorded it is in no island", "[unit][islands]") {
  DiagramBuilder builder;
  auto& pull = builder.add<Constant>("pull", 1.0);
  auto& one = builder.add<Integrator>("one");
  auto& two = builder.add<Integrator>("two");
  auto& total = builder.add<Adder>("total", "++");
  builder.connect(pull.output(), one.input()), builder.connect(pull.output(), two.input());
  builder.connect(one.output(), total.input(0)), builder.connect(two.output(), total.input(1));
  builder.export_output(total.output(), "total");
  const Diagram scene = builder.build();
  CHECK(islands_in(scene).leaves == Parts{{0, 1}, {0, 2}});
  const Islands found = islands_in(scene, {{"total", scene.output(0)}});
  CHECK(found.leaves == Parts{{0, 1, 2, 3}});
  CHECK(contains(found.describe(), "islands: 1, because of 'total.out' (reads 2 other parts)"));
}

TEST_CASE("a recorded source has the rows of its first reader, or an island of its own",
          "[unit][islands]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& lone = builder.add<Sine>("lone");
  auto& one = builder.add<Integrator>("one");
  builder.connect(sine.output(), one.input());
  builder.export_output(sine.output(), "sine"), builder.export_output(lone.output(), "lone");
  const Diagram scene = builder.build();
  const Islands found = islands_in(scene, outputs_of(scene));
  CHECK(found.leaves == Parts{{0, 2}, {1}});
  CHECK(found.taps == Parts{{0}, {1}});
}

TEST_CASE("a boolean of a source that is located joins its readers", "[unit][islands]") {
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& late = builder.add<FunctionBlock>("late", [](double t) { return t > 0.3; });
  builder.connect(clock.output(), late.input());
  for (const char* name : {"one", "two"}) {
    auto& block = builder.add<Leaf>(name, [](Leaf& l) {
      l.declare_input_port({.name = "in", .shape = Shape::scalar()});
      l.declare_continuous_state(
          {.initial = vec({0.0}), .ode = [](const At& at) { return at.u(0); }});
    });
    builder.connect(late.output(), block.input(0));
  }
  CHECK(islands_in(builder.build()).count() == 1);  // one guard, one event
}

TEST_CASE("two blocks that read each other are one island, and both are named", "[unit][islands]") {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x");
  auto& y = builder.add<Integrator>("y");
  builder.connect(x.output(), y.input()), builder.connect(y.output(), x.input());
  CHECK(islands_in(builder.build()).describe() ==
        "islands: 1, because of 'x.out' (reads 1 other part)\n");
}

TEST_CASE("the plan of an island has the paths of the whole", "[unit][islands]") {
  const Diagram scene = scene_of({0, 1, 2, 3});
  const auto plan = compile(scene, outputs_of(scene));
  const Islands found = find_islands(*plan);
  const auto part = plan_of_island(*plan, found, 3);
  REQUIRE(part->leaves.size() == 3);
  CHECK(part->leaves[0].path == "sine");
  CHECK(part->leaves[2].path == "sum");
  CHECK(part->nx == 1);
  REQUIRE(part->taps.size() == 1);
  CHECK(part->taps[0].name == "sum");
}
