// What is no guard costs no root-finding; without a Zeno tolerance nothing is held.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("a comparison that reaches no derivative, guard or reset is no guard", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& above = builder.add<Comparator>("above", ">");
  auto& integrator = builder.add<Integrator>("integrator");
  builder.connect(sine.output(), above.input(0)), builder.connect(zero.output(), above.input(1));
  builder.connect(sine.output(), integrator.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 20.0},
               {.ode_solver_method = method, .recorded_signals = {{"above", above.output()}}});
  CHECK(results.statistics.guard_calls == 0);
  CHECK(results.events.empty());
}

TEST_CASE("without a Zeno tolerance there is no Zeno event", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.5, .zeno_tolerance = 0.0})) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 3.0},
                                  {.ode_solver_method = method, .throw_errors = false});
    CHECK(count(results.events, EventKind::zeno_enter) == 0);
    CHECK(results.status == Status::chattering);
  }
}
