// Semantics 2.9: how exactly, and which first; on a curved interpolant, with every solver.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr std::array angles{-0.7, -0.31, 0.0, 0.123, 0.5};  // [rad]

/// A pendulum with counted guards at several angles. Speeds up to 1 rad/s.
Leaf pendulum(bool with_reset) {
  return Leaf("pendulum", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -std::sin(at.x[0]); }});
    l.declare_discrete_state(vec({0.0}));
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double angle = angles[i];
      l.declare_zero_crossing({.name = text("at_", i),
                               .guard = [=](const At& at) { return at.x[0] - angle; },
                               .reset_map = with_reset ? ResetMap(count_up) : ResetMap()});
    }
  });
}

}  // namespace

TEST_CASE("2.9 on its interpolant a guard is located to 100 eps (|t| + |h|), and not before zero",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_reset = GENERATE(true, false);
  INFO("method " << method << ", reset " << with_reset);
  const Leaf leaf = pendulum(with_reset);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 30.0},
                                {.ode_solver_method = method, .max_minor_step_size = 1.0});
  REQUIRE(results.events.size() >= 40);
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const Event event = results.events[i];
    const double angle = angles[std::stoul(std::string(event.name).substr(3))];
    const double beyond = event.direction * (event.before[0] - angle);
    INFO(event.name << " at " << event.time << ", beyond by " << beyond);
    CHECK(beyond >= (with_reset ? 0.0 : -8.0 * eps));  // a monitor hands nothing on
    // The slope is |v|; evaluating the interpolant rounds to a few eps of the angle.
    CHECK(beyond <= std::abs(event.before[1]) * 100.0 * eps * (event.time + 1.0) + 8.0 * eps);
  }
}

TEST_CASE("2.9 the earliest crossing among the guards of all blocks comes first", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  for (int i = 0; i < 10; ++i) {
    builder.add<Leaf>(text("block_", i), [=](Leaf& l) {
      declare_ramp(l, 1.0 + i, 0.0);
      l.declare_discrete_state(vec({0.0}));
      l.declare_zero_crossing(
          {.guard = [](const At& at) { return at.x[0] - 1.0; }, .reset_map = count_up});
    });
  }
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 1.5}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 10);
  for (std::size_t i = 0; i < 10; ++i)
    CHECK(results.events[i].block == text("block_", 9 - static_cast<int>(i)));
}
