// Semantics 3.5: which side a relation takes at its own root, and when it is read again.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// x' = 1, y' = 1 while the relation g(x) > 0 is true: y is how long it was.
template <class Guard>
Leaf stopwatch(Guard guard, bool true_at_zero) {
  return Leaf("watch", [=](Leaf& l) {
    const auto relation = l.declare_relation({.name = "relation",
                                              .guard = [=](const At& at) { return guard(at.x[0]); },
                                              .true_at_zero = true_at_zero});
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << 1.0, (at.relation(relation) ? 1.0 : 0.0);
         }});
  });
}

double true_for(const Leaf& leaf, Method method) {
  return simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method})
      .context.continuous_state()[1];
}

}  // namespace

TEST_CASE("3.5 at its root a relation takes the side that the crossing direction says",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool true_at_zero = GENERATE(true, false);
  const double root = GENERATE(0.25, 0.3, 1.0 / 3.0);
  INFO("method " << method << ", true_at_zero " << true_at_zero << ", root " << root);
  CHECK_THAT(true_for(stopwatch([=](double x) { return x - root; }, true_at_zero), method),
             WithinAbs(1.0 - root, 1e-9));
  CHECK_THAT(true_for(stopwatch([=](double x) { return root - x; }, true_at_zero), method),
             WithinAbs(root, 1e-9));
}

TEST_CASE("3.5 also where the guard stays at exactly zero from there on", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool true_at_zero = GENERATE(true, false);
  INFO("method " << method << ", true_at_zero " << true_at_zero);
  const auto rises = [](double x) { return std::min(x - 0.25, 0.0); };
  const auto falls = [](double x) { return std::max(0.25 - x, 0.0); };
  CHECK_THAT(true_for(stopwatch(rises, true_at_zero), method), WithinAbs(0.75, 1e-9));
  CHECK_THAT(true_for(stopwatch(falls, true_at_zero), method), WithinAbs(0.25, 1e-9));
}

TEST_CASE("3.5 a relation that touches zero and turns back does not change", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool true_at_zero = GENERATE(true, false);
  const double side = GENERATE(1.0, -1.0);
  INFO("method " << method << ", true_at_zero " << true_at_zero << ", side " << side);
  // The updates make steps that end exactly where x, which is t, touches zero.
  for (const bool smooth : {true, false}) {
    Leaf leaf = stopwatch(
        [=](double x) { return side * (smooth ? (x - 0.25) * (x - 0.25) : std::abs(x - 0.25)); },
        true_at_zero);
    leaf.declare_periodic_update([](const At&, Next&) {}, 0.125);
    const auto results =
        simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
    CHECK(results.events.times("relation").empty());
    CHECK_THAT(results.context.continuous_state()[1], WithinAbs(side > 0.0 ? 1.0 : 0.0, 1e-9));
  }
}

TEST_CASE("3.5 a relation that a commit puts at exactly zero keeps the side it has",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double before = GENERATE(1.0, -1.0);
  const bool continuous = GENERATE(true, false);  // what it reads: a still state, or a held one
  INFO("method " << method << ", before " << before << ", continuous " << continuous);
  const Leaf leaf("leaf", [=](Leaf& l) {
    const auto relation = l.declare_relation({.name = "relation", .guard = [=](const At& at) {
                                                return continuous ? at.x[1] : at.z[0];
                                              }});
    l.declare_continuous_state(
        {.initial = vec({0.0, before}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << (at.relation(relation) ? 1.0 : 0.0), 0.0;
         }});
    l.declare_discrete_state(vec({before}));
    l.declare_one_shot(0.5, [](const At& at, Next& next) {
      next.set_continuous_state({at.x[0], 0.0});
      next.set_discrete_state({0.0});
    });
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(before > 0.0 ? 1.0 : 0.0, 1e-9));
}

TEST_CASE("3.5 a relation at its root is not read again for what another block writes",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // sin(7 pi t) has six zeros in (0, 1). Another block writes at the very same times: whatever
  // rounding left at the root, the relation has one side from one zero to the next.
  const double w = 7.0 * std::acos(-1.0);
  const auto wave = [=](double x) { return std::cos(w * x); };
  DiagramBuilder builder;
  const auto watch = std::make_shared<Leaf>(stopwatch(wave, false));
  watch->declare_continuous_state_output("x");
  auto& writer = builder.add<Leaf>("writer", [=](Leaf& l) {
    l.declare_input_port({.name = "x", .shape = Shape::of(2)});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "write",
                             .guard = [=](const At& at) { return wave(at.u(0)); },
                             .reset_map = count_up});
  });
  builder.add(watch);
  builder.connect(watch->output(), writer.input());
  const Diagram diagram = builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 1.0},
                                {.ode_solver_method = method, .max_minor_step_size = 0.05});
  CHECK(results.events.times("watch.relation").size() == 7);
  CHECK(results.events.times("writer.write").size() == 7);
  // True for half a period at the start, then every second one: 1/14 + 3/7 s.
  CHECK_THAT(results.context.continuous_state()[1], WithinAbs(0.5, 1e-9));
}
