// Semantics 2.1, 2.2: what a guard reads, and on which side it is armed.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// x' = 1, falling guard 1 - x + 2 level; `jump` at 0.25 s.
Leaf falling(std::function<double(double)> guard, std::function<double(double)> jump = {}) {
  return Leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "hit",
                             .guard = [=](const At& at) { return guard(at.x[0]); },
                             .reset_map = [](const At&, Next&) {},
                             .direction = Direction::positive_then_non_positive});
    if (jump)
      l.declare_one_shot(
          0.25, [=](const At& at, Next& next) { next.set_continuous_state({jump(at.x[0])}); });
  });
}

std::vector<double> hits(const Leaf& leaf, Method method) {
  return simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method})
      .events.times("hit");
}

}  // namespace

TEST_CASE("2.1 a guard is a function of t, x, z, m, u and p", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& constant = builder.add<Constant>("constant", 0.25);
  auto& leaf = builder.add<Leaf>("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_input_port({.name = "u", .shape = Shape::scalar()});
    l.declare_discrete_state(vec({0.125}));
    l.declare_default_mode(1);
    l.declare_dynamic_parameter("p", 0.5);
    l.declare_zero_crossing({.name = "sum", .guard = [](const At& at) {
                               return at.time + at.x[0] + at.z[0] + at.mode + at.u(0) + at.p[0] -
                                      3.0;
                             }});
  });
  builder.connect(constant.output(), leaf.input());
  const Diagram diagram = builder.build();
  const auto start = diagram.create_context();
  const auto part = start[leaf.system_id()];
  const auto found = [&](const Context& context) {
    const auto results = simulate(diagram, context, {0.0, 2.0}, {.ode_solver_method = method});
    REQUIRE(results.events.size() == 1);
    return results.events[0].time;
  };
  const auto with = [&](const Context& changed) {
    return start.with_subcontext(leaf.system_id(), changed);
  };
  // 2 t = 3 - 1/8 - 1 - 1/4 - 1/2; one unit more in any of them is half a second less.
  CHECK_THAT(found(start), WithinAbs(0.5625, 1e-9));
  CHECK_THAT(found(with(part.with_continuous_state({1.0}))), WithinAbs(0.0625, 1e-9));
  CHECK_THAT(found(with(part.with_discrete_state({1.125}))), WithinAbs(0.0625, 1e-9));
  CHECK_THAT(found(with(part.with_mode(2))), WithinAbs(0.0625, 1e-9));
  CHECK_THAT(found(with(part.with_parameter("p", 1.5))), WithinAbs(0.0625, 1e-9));
}

TEST_CASE("2.1 edge_detection fires at each change of a held signal, at its very time",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_state = GENERATE(true, false);
  INFO("method " << method << ", state " << with_state);
  DiagramBuilder builder;
  auto& pulse = builder.add<Pulse>(
      "pulse", Pulse::Options{.period = 1.0, .pulse_width = 0.5, .phase_delay = 0.25});
  auto& leaf = builder.add<Leaf>("leaf", [=](Leaf& l) {
    l.declare_input_port({.name = "u", .shape = Shape::scalar()});
    if (with_state) declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "edge",
                             .guard = [](const At& at) { return at.u(0); },
                             .reset_map = count_up,
                             .direction = Direction::edge_detection});
  });
  builder.connect(pulse.output(), leaf.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  CHECK(results.events.times("leaf.edge") == std::vector{0.25, 0.75, 1.25, 1.75});
}

TEST_CASE("2.1 crosses_zero is the direction of a guard that does not say one", "[semantics]") {
  CHECK(ZeroCrossing{}.direction == Direction::crosses_zero);
}

TEST_CASE("2.2 a guard that reaches zero and goes no further fires", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto found = hits(falling([](double x) { return std::max(0.5 - x, 0.0); }), method);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(0.5, 1e-9));
}

TEST_CASE("2.2 a guard is armed anew on the side where a restart finds it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // 1 - x: starts below zero at x = 2 and falls on; a jump to x = 0 arms it above.
  const Leaf leaf = falling([](double x) { return 1.0 - x; }, [](double) { return 0.0; });
  const auto results = simulate(leaf, leaf.create_context().with_continuous_state({2.0}),
                                {0.0, 2.0}, {.ode_solver_method = method});
  const auto found = results.events.times("hit");
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(1.25, 1e-9));
}

TEST_CASE("2.2 a jump to the armed side fires no falling guard", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // x goes past 1 at 1 s, and the guard with it; from 0.25 s on it is one second earlier.
  CHECK(hits(falling([](double x) { return x - 1.0; }), method).empty());
  CHECK(
      hits(falling([](double x) { return x - 1.0; }, [](double) { return 1.5; }), method).empty());
}
