// No stiffness: no Jacobian, no linear algebra. No discontinuity in the right-hand side: no
// restart.
#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// An oscillator whose Jacobian counts its calls.
Leaf oscillator(int& calls) {
  return Leaf("oscillator", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_jacobian([&](const At&, MatrixRef j) { ++calls, j << 0.0, 1.0, -1.0, 0.0; });
  });
}

}  // namespace

TEST_CASE("a scene that is not stiff has no Jacobian and no linear solver", "[absent]") {
  const auto method = GENERATE(Method::dopri5, Method::adams, Method::automatic);
  INFO("method " << method);
  int calls = 0;
  const Leaf leaf = oscillator(calls);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 100.0}, {.ode_solver_method = method});
  CHECK(calls == 0);
  CHECK(results.statistics.jacobian_calls == 0);
  CHECK(results.statistics.linear_setups == 0);
  CHECK(!contains(results.statistics.method, "bdf"));
  CHECK(!contains(results.statistics.method, "then radau"));
}

TEST_CASE("a method that is not stiff looks at no sparsity, colours nothing, has no linear solver",
          "[absent]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::adams, Method::automatic);
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; },
         .sparsity = std::vector<MatrixEntry>{{7, 7}}});  // an error for who looks
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 10.0}, {.ode_solver_method = method});
  CHECK(results.statistics.linear_solver.empty());
  CHECK_THROWS_AS(
      simulate(leaf, leaf.create_context(), {0.0, 10.0}, {.ode_solver_method = Method::bdf}),
      ModelError);
}

TEST_CASE("BDF asks the leaf for its Jacobian where there is one, and makes no differences",
          "[absent]") {
  int calls = 0;
  const Leaf leaf = oscillator(calls);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 100.0}, {.ode_solver_method = Method::bdf});
  CHECK(calls > 0);
  CHECK(results.statistics.jacobian_calls == calls);
  // Newton needs one or two evaluations a step; differences would add one a state for each
  // Jacobian.
  CHECK(results.statistics.right_hand_side_calls <
        3 * (results.statistics.steps + results.statistics.rejected) + 10);
}

TEST_CASE("updates that no derivative reads restart nothing", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& integrator = builder.add<Integrator>("integrator");
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.1);
  auto& step = builder.add<Step>("step", Step::Options{.step_time = 0.5});
  auto& gain = builder.add<Gain>("gain", 2.0);
  builder.connect(sine.output(), integrator.input()),
      builder.connect(integrator.output(), hold.input());
  builder.connect(step.output(), gain.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 10.0},
               {.ode_solver_method = method, .recorded_signals = {{"gain", gain.output()}}});
  CHECK(count(results.events, EventKind::time) == 102);
  CHECK(results.statistics.restarts == 0);
}

TEST_CASE("a held signal that a derivative reads restarts it when it changes, and only then",
          "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& pulse = builder.add<Pulse>("pulse", Pulse::Options{.period = 1.0, .pulse_width = 0.5});
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.05);
  auto& integrator = builder.add<Integrator>("integrator");
  builder.connect(pulse.output(), hold.input()), builder.connect(hold.output(), integrator.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 10.01}, {.ode_solver_method = method});
  // The hold changes at 0, 0.5, ..., 10: at 0 the solver has not started yet.
  CHECK(results.statistics.restarts == 20);
}
