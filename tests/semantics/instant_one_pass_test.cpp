// Semantics 3.2, 3.3, 3.8: what happens in one pass sees the state before it.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A bead on a line that meets the bead of its input: equal masses swap their velocities.
std::shared_ptr<Leaf> bead(std::string name, double x, double v, double side) {
  return std::make_shared<Leaf>(std::move(name), [=](Leaf& l) {
    l.declare_input_port({.name = "other", .shape = Shape::of(2)});
    l.declare_continuous_state({.initial = vec({x, v}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], 0.0; },
                                .reads = Reads::continuous_state});
    l.declare_continuous_state_output("state");
    l.declare_zero_crossing(
        {.name = "meet",
         .guard = [=](const At& at) { return side * (at.u(0) - at.x[0]); },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.x[0], at.u[0][1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

void set_to(Leaf& l, const char* name, std::function<double(double)> map) {
  l.declare_zero_crossing(
      {.name = name,
       .guard = [](const At& at) { return at.x[0] - 0.5; },
       .reset_map = [=](const At& at, Next& next) { next.set_continuous_state({map(at.x[0])}); },
       .direction = Direction::negative_then_non_negative});
}

}  // namespace

TEST_CASE("3.2 across leaves each reset map sees the state before: two beads swap velocities",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  const auto a = bead("a", 0.0, 3.0, 1.0), b = bead("b", 1.0, -0.7, -1.0);
  builder.add(a), builder.add(b);
  builder.connect(a->output(), b->input()), builder.connect(b->output(), a->input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 2);
  CHECK(results.events[0].time == results.events[1].time);
  CHECK(results.events[0].jump == 1);
  CHECK(results.events[1].jump == 1);
  CHECK_THAT(results.events[0].time, WithinAbs(1.0 / 3.7, 1e-9));
  const auto& x = results.context.continuous_state();
  CHECK(x[1] == -0.7);
  CHECK(x[3] == 3.0);
}

TEST_CASE("3.3 an update at the time of a guard reads the state before the reset", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& saw = builder.add<Leaf>("saw", [](Leaf& l) {
    declare_ramp(l);
    set_to(l, "full", [](double) { return 0.0; });
  });
  auto& sample = builder.add<Leaf>("sample", [](Leaf& l) {
    l.declare_input_port({.name = "x", .shape = Shape::of(1)});
    l.declare_discrete_state(vec({-1.0}));
    l.declare_one_shot(0.5, [](const At& at, Next& next) { next.set_discrete_state({at.u(0)}); });
  });
  builder.connect(saw.output(), sample.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 0.75}, {.ode_solver_method = method});
  CHECK_THAT(results.context.discrete_state()[0], WithinAbs(0.5, 1e-9));
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.25, 1e-9));
}

TEST_CASE("3.8 of two reset maps of one pass on one state, declaration order decides",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto set = [](double) { return -10.0; };
  const auto twice = [](double x) { return 2.0 * x; };
  const Leaf set_first(
      "leaf", [&](Leaf& l) { declare_ramp(l), set_to(l, "set", set), set_to(l, "twice", twice); });
  const Leaf set_last(
      "leaf", [&](Leaf& l) { declare_ramp(l), set_to(l, "twice", twice), set_to(l, "set", set); });
  const auto end = [&](const Leaf& leaf) {
    const auto results =
        simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
    CHECK(results.events.size() == 2);
    CHECK(results.events[1].jump == 1);
    return results.context.continuous_state()[0];
  };
  CHECK_THAT(end(set_first), WithinAbs(-20.0 + 0.5, 1e-9));
  CHECK_THAT(end(set_last), WithinAbs(-10.0 + 0.5, 1e-9));
}

TEST_CASE("3.8 a reset in one leaf leaves the state of another as it is", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  builder.add<Leaf>(
      "other", [](Leaf& l) { declare_ramp(l, 0.0, 0.1), l.declare_discrete_state(vec({0.7})); });
  builder.add<Leaf>("saw", [](Leaf& l) {
    declare_ramp(l);
    set_to(l, "full", [](double) { return 0.0; });
  });
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 5.25}, {.ode_solver_method = method});
  CHECK(results.events.size() == 10);
  CHECK(results.context.continuous_state()[0] == 0.1);
  CHECK(results.context.discrete_state()[0] == 0.7);
}
