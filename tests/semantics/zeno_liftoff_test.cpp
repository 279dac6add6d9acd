// Semantics 4.5: a body at rest that something lifts: the flow, were it not held, leads its guard
// to the armed side.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 10.0;

/// A box at rest on its floor whose thrust steps from 0 to `thrust` [m/s^2] at 1 s.
Results pushed(double thrust, Method method) {
  DiagramBuilder builder;
  auto& step = builder.add<Step>("thrust", Step::Options{.end_value = thrust, .step_time = 1.0});
  auto& box = builder.add<Leaf>("box", [](Leaf& l) {
    l.declare_input_port({.name = "thrust", .shape = Shape::scalar()});
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], at.u(0) - g; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
  builder.connect(step.output(), box.input());
  const Diagram diagram = builder.build();
  return simulate(diagram, diagram.create_context(), {0.0, 2.0},
                  {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
}

}  // namespace

TEST_CASE("4.5 a thrust below the weight leaves a held box where it is", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto results = pushed(0.5 * g, method);
  CHECK(results.events.times("bounce", EventKind::zeno_release).empty());
  CHECK(results.context.continuous_state() == vec({0.0, 0.0}));
}

TEST_CASE("4.5 a thrust above the weight lifts a held box off, at its very time", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto results = pushed(2.0 * g, method);
  CHECK(results.events.times("bounce", EventKind::zeno_release) == std::vector{1.0});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.5 * g, 1e-7));
}

TEST_CASE("4.5 a mode that does not see the guard of a hold ends it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf rocket("rocket", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], (at.mode == 0 ? -g : 5.0); }});
    l.declare_default_mode(0);
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive,
         .start_mode = 0});
    l.declare_zero_crossing({.name = "ignite",
                             .guard = [](const At& at) { return at.time - 1.0; },
                             .start_mode = 0,
                             .end_mode = 1});
  });
  const auto results = simulate(rocket, rocket.create_context(), {0.0, 2.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  CHECK(results.context.mode() == 1);
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(2.5, 1e-7));
}
