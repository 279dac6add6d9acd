// Edges: which changes of a watched signal trigger a reset.
#include "saltus/simulation/detail/edges.hpp"

#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Three leaves that watch `x > 0` for a rising, a falling and either edge.
Diagram watchers() {
  DiagramBuilder builder;
  auto& state = builder.add<Leaf>("state", [](Leaf& l) { declare_ramp(l); });
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& above = builder.add<Comparator>("above", ">");
  builder.connect(state.output(0), above.input(0)), builder.connect(zero.output(), above.input(1));
  for (const auto& [name, edge] :
       {std::pair{"rising", Edge::rising}, {"falling", Edge::falling}, {"either", Edge::either}}) {
    auto& leaf = builder.add<Leaf>(name, [edge = edge](Leaf& l) {
      declare_ramp(l);
      const int input = l.declare_input_port({.name = "signal"});
      l.declare_edge_reset({.name = "flank", .input = input, .edge = edge, .reset_map = count_up});
    });
    builder.connect(above.output(), leaf.input(0));
  }
  return builder.build();
}

struct Signal {
  Diagram diagram = watchers();
  Machine machine{compile(diagram)};
  Edges edges{machine};

  explicit Signal(bool at_start) {
    machine.load(diagram.create_context());
    set(at_start);
    edges.begin(), edges.open();
  }
  void set(bool value) {
    machine.truth_at(relation(), 0) = value ? 1.0 : 0.0;
    machine.evaluate_instant(0.0);
  }
  int relation() const { return machine.plan().edge(0).relations.at(0); }
};

}  // namespace

TEST_CASE("a signal fires at the edge that its reset asks for, and at no other", "[edges]") {
  struct Row {
    bool before, now;
    std::vector<bool> fires;  // rising, falling, either
  };
  const auto row = GENERATE(values<Row>({{false, false, {false, false, false}},
                                         {false, true, {true, false, true}},
                                         {true, false, {false, true, true}},
                                         {true, true, {false, false, false}}}));
  INFO("from " << row.before << " to " << row.now);
  Signal signal(row.before);
  signal.set(row.now);
  for (std::size_t e = 0; e < 3; ++e) {
    const Edges::Look look = signal.edges.look(e);
    CHECK(look.now == row.now);
    CHECK(look.fires == row.fires[e]);
    CHECK_FALSE(signal.edges.look(e).fires);  // an edge is seen once
  }
}

TEST_CASE("an instant begins without events, and keeps the values", "[edges]") {
  Signal signal(false);
  signal.edges.fired(2), signal.edges.carried(1);
  CHECK(signal.edges.fired() == std::vector{2});
  CHECK(signal.edges.has_fired(2));
  CHECK_FALSE(signal.edges.has_fired(1));
  CHECK(signal.edges.is_carried(1));
  signal.set(true);
  signal.edges.look(0);
  signal.edges.open();
  CHECK(signal.edges.fired().empty());
  CHECK_FALSE(signal.edges.is_carried(1));
  CHECK_FALSE(signal.edges.look(0).fires);
  CHECK(signal.edges.look(2).fires);
}

TEST_CASE("a relation set off an edge while the signal has the value that fired it", "[edges]") {
  const auto [e, value] = GENERATE(table<std::size_t, bool>({{0, true}, {1, false}, {2, true}}));
  INFO("edge " << e);
  Signal signal(!value);
  signal.set(value);
  CHECK_FALSE(signal.edges.set_off_by(signal.relation()));
  signal.edges.fired(e);
  CHECK(signal.edges.set_off_by(signal.relation()));
  CHECK_FALSE(signal.edges.set_off_by(-1));
  signal.set(!value);
  CHECK_FALSE(signal.edges.set_off_by(signal.relation()));
}

TEST_CASE("a continued run sees no edge that the earlier run has seen", "[edges]") {
  Signal earlier(false), later(false);
  earlier.set(true), later.set(true);
  earlier.edges.look(0);
  const Continuation saved{.edges = earlier.edges.save()};
  REQUIRE(later.edges.fits(saved));
  CHECK_FALSE(later.edges.fits({.edges = {1}}));
  later.edges.load(saved);
  CHECK_FALSE(later.edges.look(0).fires);
  CHECK(later.edges.look(2).fires);
}
