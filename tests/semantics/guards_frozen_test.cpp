// Semantics 2.10, 2.11: monitors and recording move nothing; between instants nothing else moves.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("2.10 a monitor in another block changes no bit of a diagram", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto run = [&](bool watched) {
    DiagramBuilder builder;
    auto& swing = builder.add<Leaf>("swing", [](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0, 0.0}),
           .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -std::sin(at.x[0]); }});
      l.declare_continuous_state_output("x");
    });
    auto& watch = builder.add<Leaf>("watch", [=](Leaf& l) {
      l.declare_input_port({.name = "x", .shape = Shape::of(2)});
      if (watched)
        l.declare_zero_crossing({.name = "down", .guard = [](const At& at) { return at.u(0); }});
    });
    builder.connect(swing.output(), watch.input());
    const Diagram diagram = builder.build();
    return simulate(diagram, diagram.create_context(), {0.0, 30.0}, {.ode_solver_method = method});
  };
  const auto with = run(true), without = run(false);
  CHECK(with.events.size() >= 8);
  CHECK(with.context.continuous_state() == without.context.continuous_state());
  CHECK(with.statistics.steps == without.statistics.steps);
  CHECK(with.statistics.restarts == 0);
}

TEST_CASE("2.11 a relation, a mode, a held input and discrete state change at instants only",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // x' = 1 in one long step. Each call sees what was at the last instant, also where x, or t, of a
  // trial step is far beyond the next one; and none sees the value before again.
  struct Seen {
    bool changed = false, back = false, beyond = false;
    void see(bool now, bool passed) {
      back = back || (changed && !now);
      changed = changed || now;
      beyond = beyond || (!now && passed);
    }
  };
  Seen relation, mode, discrete, held;
  DiagramBuilder builder;
  auto& step = builder.add<Step>("step", Step::Options{.step_time = 0.6});
  auto& leaf = builder.add<Leaf>("leaf", [&](Leaf& l) {
    l.declare_input_port({.name = "u", .shape = Shape::scalar()});
    const auto above =
        l.declare_relation({.name = "above", .guard = [](const At& at) { return at.x[0] - 0.5; }});
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [&, above](const At& at) {
                                  relation.see(at.relation(above), at.x[0] > 0.501);
                                  mode.see(at.mode == 1, at.x[0] > 0.701);
                                  discrete.see(at.z[0] == 1.0, false);
                                  held.see(at.u(0) == 1.0, false);
                                  return 1.0;
                                }});
    l.declare_default_mode(0);
    l.declare_zero_crossing({.name = "change",
                             .guard = [](const At& at) { return at.x[0] - 0.7; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(0.8, count_up);
  });
  builder.connect(step.output(), leaf.input());
  const Diagram diagram = builder.build();
  simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  for (const Seen* seen : {&relation, &mode, &discrete, &held}) {
    CHECK(seen->changed);
    CHECK(!seen->back);
  }
  CHECK(relation.beyond);
  CHECK(mode.beyond);
}
