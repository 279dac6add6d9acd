// Semantics 2.5, 2.6: bodies that touch while nothing pushes them together, and then something
// does.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 10.0;

/// A box over a floor at 0 under its weight and a thrust that carries it until `off` [s]: it sinks
/// with the speed it has.
Results box(double y, double v, double off, double end, Method method) {
  DiagramBuilder builder;
  auto& thrust = builder.add<Step>(
      "thrust", Step::Options{.start_value = g, .end_value = 0.0, .step_time = off});
  auto& body = builder.add<Leaf>("box", [=](Leaf& l) {
    l.declare_input_port({.name = "thrust", .shape = Shape::scalar()});
    l.declare_continuous_state({.initial = vec({y, v}), .ode = [](const At& at, VectorRef xdot) {
                                  xdot << at.x[1], at.u(0) - g;
                                }});
    l.declare_zero_crossing(
        {.name = "land",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0, 0.0}); },
         .direction = Direction::positive_then_non_positive});
  });
  builder.connect(thrust.output(), body.input());
  const Diagram diagram = builder.build();
  return simulate(diagram, diagram.create_context(), {0.0, end}, {.ode_solver_method = method});
}

/// Three beads on a line, the first one moving; equal masses swap velocities.
Leaf cradle(double gap) {
  return Leaf("cradle", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0, 1.0 + gap, 1.0, 0.0, 0.0}),
         .ode = [](const At& at, VectorRef f) { f.head(3) = at.x.tail(3), f.tail(3).setZero(); }});
    for (const Index i : {0, 1}) {
      l.declare_zero_crossing({.name = text("meet_", i),
                               .guard = [=](const At& at) { return at.x[i + 1] - at.x[i]; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     Eigen::VectorXd x = at.x;
                                     std::swap(x[3 + i], x[4 + i]);
                                     next.set_continuous_state(x);
                                   },
                               .direction = Direction::positive_then_non_positive});
    }
  });
}

}  // namespace

TEST_CASE("2.6 a box that stood weightless on its floor rests there when its thrust ends",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto placed = box(0.0, 0.0, 1.0, 2.0, method);
  CHECK_THAT(placed.context.continuous_state()[0], WithinAbs(0.0, 1e-12));
  const auto landed = box(1.0, -2.0, 1.0, 2.0, method);  // at 0.5 s
  CHECK_THAT(landed.context.continuous_state()[0], WithinAbs(0.0, 1e-12));
}

TEST_CASE("2.6 beads that touch pass on a push: Newton's cradle", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = cradle(0.0);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.5}, {.ode_solver_method = method});
  CHECK((results.context.continuous_state() - vec({1.0, 1.0, 1.5, 0.0, 0.0, 1.0})).norm() < 1e-9);
  CHECK(results.events.size() == 2);
}

TEST_CASE("2.5 beads with a gap pass on a push one after the other", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = cradle(0.1);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.5}, {.ode_solver_method = method});
  CHECK((results.context.continuous_state() - vec({1.0, 1.1, 1.5, 0.0, 0.0, 1.0})).norm() < 1e-9);
  CHECK(results.events.size() == 2);
}

TEST_CASE("2.5 a floor that steps up past a rising ball lets it not fall through", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto step = [] {
    return std::make_shared<Step>("floor", Step::Options{.end_value = 3.0, .step_time = 0.1});
  };
  for (const BallScene& scene : all_forms_over({.g = g, .e = 0.5}, step)) {
    INFO(scene.form << ", method " << method);
    // The reset map turns an upward velocity down, into the floor: no time can pass, it rests.
    const auto results = simulate(*scene.system, scene.context(0.0, 5.0), {0.0, 1.0},
                                  {.ode_solver_method = method, .throw_errors = false});
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(3.0, 1e-6));
  }
}
