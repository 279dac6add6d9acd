// 5.1, 5.8: where a block comes to rest, the last row at that time has the state in which it rests.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace rows_at_rest_test {

/// A ball with drag: its gaps are no exact series, so the last reset may leave a flight too short to be
/// seen.
Leaf ball(double drag, double e) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], -9.81 - drag * at.x[1] * std::abs(at.x[1]);
         }});
    l.declare_continuous_state_output("state");
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace rows_at_rest_test

using namespace rows_at_rest_test;

TEST_CASE("the last row where a ball comes to rest has no velocity", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.5, 0.8, 0.93), drag = GENERATE(0.0, 0.1, 0.7);
  INFO("method " << method << ", e " << e << ", drag " << drag);
  const Leaf leaf = ball(drag, e);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 20.0},
               {.ode_solver_method = method, .recorded_signals = {{"state", leaf.output(0)}}});
  REQUIRE(count(results.events, EventKind::zeno_enter) == 1);
  const auto rests = [&](std::size_t i) { return results.events[i].kind == EventKind::zeno_enter; };
  std::size_t event = 0;
  while (!rests(event)) ++event;
  std::size_t row = 0;
  for (std::size_t i = 0; i < results.time.size(); ++i)
    if (results.time[i] <= results.events[event].time) row = i;
  CHECK(results.time[row] == results.events[event].time);
  const auto& state = results.signals[0].values;
  CHECK(state[2 * row] == results.context.continuous_state()[0]);
  CHECK(state[2 * row + 1] == results.context.continuous_state()[1]);
  CHECK(results.events[event].after[1] == state[2 * row + 1]);
}
