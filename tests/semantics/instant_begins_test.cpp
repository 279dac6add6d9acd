// Semantics 3.1: what begins an instant; time events are exact stops.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("3.1 a time event is an exact stop: offset + k period to the last bit", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_state = GENERATE(true, false);
  INFO("method " << method << ", state " << with_state);
  const double period = 1.0 / 3.0, offset = 0.1;
  const Leaf leaf("leaf", [&](Leaf& l) {
    if (with_state) declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(count_up, period, offset, "tick");
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 100.0}, {.ode_solver_method = method});
  const auto times = results.events.times("tick", EventKind::time);
  REQUIRE(times.size() == 300);
  for (std::size_t k = 0; k < times.size(); ++k)
    REQUIRE(times[k] == offset + static_cast<double>(k) * period);
  CHECK(results.statistics.guard_calls == 0);  // never found by root-finding
}

TEST_CASE("3.1 equal times in several blocks are one instant, and one pass", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  for (int i = 0; i < 3; ++i) {
    builder.add<Leaf>(text("block_", i), [=](Leaf& l) {
      declare_ramp(l);
      l.declare_continuous_state_output();
      l.declare_discrete_state(vec({0.0}));
      // 0.3 and 3 * 0.1 differ in the last bit.
      if (i == 0)
        l.declare_one_shot(0.3, count_up);
      else
        l.declare_periodic_update(count_up, 0.1 * i, 0.3 - 0.1 * i + 0.1 * i);
    });
  }
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 0.35}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(results.events[i].time == results.events[0].time);
    CHECK(results.events[i].jump == 1);
  }
}

TEST_CASE("3.1 the start of a run is an instant: what is due at t0 happens before the first step",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l, -1.0, 0.0);
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(0.0, [](const At&, Next& next) { next.set_continuous_state({2.0}); });
    l.declare_zero_crossing({.name = "empty",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = count_up,
                             .direction = Direction::positive_then_non_positive});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  // The update at t0 lifts the state off its guard before integration arms it.
  CHECK(results.context.discrete_state()[0] == 0.0);
  CHECK(std::abs(results.context.continuous_state()[0] - 1.0) < 1e-9);
}
