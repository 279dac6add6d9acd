// Relations: a truth is held between instants, takes the side of its crossing, and is read again
// only when something it reads was written.
#include "saltus/simulation/detail/relations.hpp"

#include "saltus/library/library.hpp"
#include "support/instants.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A block `source`, with x' = rate and a discrete state z: its time events add 1 to x and to z.
/// x, or z if `held`, is compared with a level by `operation`. A block `counter` counts the edges
/// of the comparison.
std::shared_ptr<Diagram> compared(const char* operation, double level, bool held, double rate) {
  DiagramBuilder builder;
  auto& source = builder.add<Leaf>("source", [rate](Leaf& l) {
    declare_ramp(l, rate);
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("z");
    l.declare_one_shot(
        1.0, [](const At& at, Next& next) { next.set_continuous_state({at.x[0] + 1.0}); }, "add");
    l.declare_one_shot(
        2.0, [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0}); }, "count");
  });
  auto& other = builder.add<Leaf>("other", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(3.0, &count_up, "elsewhere");
  });
  auto& limit = builder.add<Constant>("level", level);
  auto& above = builder.add<Comparator>("above", operation);
  auto& counter = builder.add<Leaf>("counter", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    const int input = l.declare_input_port({.name = "signal"});
    l.declare_edge_reset(
        {.name = "edge", .input = input, .edge = Edge::either, .reset_map = &count_up});
  });
  builder.connect(source.output(held ? 1 : 0), above.input(0));
  builder.connect(limit.output(), above.input(1));
  builder.connect(above.output(), counter.input(0));
  static_cast<void>(other);
  return std::make_shared<Diagram>(builder.build());
}

constexpr int add = 0, count_z = 1, elsewhere = 2;

/// x = (source, other, counter); z likewise.
struct Compared : Instants {
  Compared(const char* operation, double level, bool held = false, double rate = 1.0)
      : Instants(compared(operation, level, held, rate)) {}
  bool truth() const { return machine.truth(machine.plan().edge(0).node); }
  double edges() const { return machine.z[2]; }
};

Eigen::VectorXd state(double x) { return vec({x, 0.0, 0.0}); }

}  // namespace

TEST_CASE("at the beginning a truth follows the sign; at zero it is that of its operator",
          "[relations]") {
  struct Row {
    const char* operation;
    double x;
    bool truth;
  };
  const auto row = GENERATE(values<Row>({{">", 0.9, false},
                                         {">", 1.1, true},
                                         {"<", 0.9, true},
                                         {"<", 1.1, false},
                                         {">=", 1.1, true},
                                         {"<=", 1.1, false}}));
  INFO(row.operation << " 1 at " << row.x);
  Compared run(row.operation, 1.0);
  run.begin(0.0, state(row.x));
  CHECK(run.truth() == row.truth);
  CHECK(run.edges() == 0.0);

  Compared held(row.operation, 0.0, true);  // nothing moves a held signal
  held.begin(0.0, state(0.0));
  CHECK(held.truth() == (row.operation[1] == '='));
}

TEST_CASE("a truth that crosses has the side of its crossing, even exactly at its root",
          "[relations]") {
  const double x = GENERATE(1.0, 1.0 + 2.0 * eps, 1.0 - 2.0 * eps);
  const int to = GENERATE(1, -1);
  INFO("to " << to << ", beyond by " << x - 1.0);
  Compared run(">", 1.0, false, to);
  run.begin(0.0, state(1.0 - 0.5 * to));
  run.fire(1.0, state(x), 0, -to);
  CHECK(run.truth() == (to > 0));
}

TEST_CASE("an edge fires in the pass of the relation that made it", "[relations]") {
  Compared run(">", 1.0);
  run.begin(0.0, state(0.0));
  run.fire(1.0, state(1.0), 0, -1);
  CHECK(run.edges() == 1.0);
  REQUIRE(run.results.events.size() == 2);
  CHECK(run.results.events[0].block == "above");
  CHECK(run.results.events[1].block == "counter");
  CHECK(run.results.events[0].jump == run.results.events[1].jump);
  CHECK(run.results.events[0].direction == 1);
}

TEST_CASE("a write that moves a relation across zero turns it at the same time", "[relations]") {
  Compared run(">", 0.5);
  run.begin(0.0, state(0.0));
  run.tick(1.0, state(0.25), add);
  CHECK(run.truth());
  CHECK(run.edges() == 1.0);
  Compared held(">", 0.5, true);
  held.begin(0.0, state(0.0));
  held.tick(1.0, state(0.0), count_z);
  CHECK(held.truth());
  CHECK(held.edges() == 1.0);
}

TEST_CASE("a write that puts a relation exactly at zero leaves it its truth", "[relations]") {
  const char* operation = GENERATE(">", "<", ">=", "<=");
  INFO("operator " << operation);
  Compared run(operation, 1.0, false, 0.0);
  run.begin(0.0, state(0.0));
  const bool before = run.truth();
  run.tick(1.0, state(0.0), add);
  CHECK(run.machine.x[0] == 1.0);
  CHECK(run.truth() == before);
  CHECK(run.edges() == 0.0);
}

TEST_CASE("what another block writes turns no relation", "[relations]") {
  const double x = GENERATE(1.0, 1.0 + 1e-9);
  Compared run(">", 1.0);
  run.begin(0.0, state(0.0));
  run.fire(1.0, state(1.0), 0, -1);
  run.tick(1.0, state(x), elsewhere);
  CHECK(run.truth());
  CHECK(run.edges() == 1.0);
}

TEST_CASE("relations that read each other agree at the beginning", "[relations]") {
  DiagramBuilder builder;
  auto& source = builder.add<Leaf>("source", [](Leaf& l) { declare_ramp(l); });
  auto& level = builder.add<Constant>("level", 0.5);
  std::vector<Comparator*> chain;
  for (int i = 0; i < 4; ++i) {  // true, false, true, false
    auto& next = builder.add<Comparator>(text("c", i), i == 0 ? ">" : "<");
    builder.connect(i == 0 ? source.output(0) : chain.back()->output(), next.input(0));
    builder.connect(level.output(), next.input(1));
    chain.push_back(&next);
  }
  auto& counter = builder.add<Leaf>("counter", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    const int input = l.declare_input_port({.name = "signal"});
    l.declare_edge_reset({.name = "edge", .input = input, .reset_map = &count_up});
  });
  builder.connect(chain.back()->output(), counter.input(0));
  Instants run(std::make_shared<Diagram>(builder.build()));
  for (const double x : {0.9, 0.1}) {
    run.begin(0.0, vec({x, 0.0}));
    CHECK(run.machine.truth(run.machine.plan().edge(0).node) == (x < 0.5));
    CHECK(run.results.events.empty());
  }
}

TEST_CASE("a continued run has the truths of the earlier one, whatever the signs are",
          "[relations]") {
  Compared earlier(">", 1.0), later(">", 1.0);
  earlier.begin(0.0, state(0.0));
  earlier.fire(1.0, state(1.0), 0, -1);
  later.machine.x = earlier.machine.x;
  const Continuation between = earlier.instant.save();
  later.instant.resume(1.0, nullptr, between, 10.0);
  CHECK(later.truth());
}

TEST_CASE("a relation whose both sides lead back to its surface flutters", "[relations]") {
  // x' is -1 above zero and +1 below, or +1 on both sides.
  const auto flutters = [](double above) {
    Instants run(std::make_shared<Leaf>("relay", [above](Leaf& l) {
      const auto r = std::make_shared<RelationIndex>();
      l.declare_continuous_state(
          {.initial = vec({-1.0}), .ode = [above, r](const At& at, VectorRef xdot) {
             xdot[0] = at.relation(*r) ? above : 1.0;
           }});
      *r = l.declare_relation({.name = "sign", .guard = [](const At& at) { return at.x[0]; }});
    }));
    run.begin(0.0, vec({-1.0}));
    return run.fire(1.0, vec({0.0}), 0, -1).flutters;
  };
  CHECK(flutters(-1.0));
  CHECK_FALSE(flutters(1.0));
}
