// Semantics 2.5: a reset may leave the guard beyond zero.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("2.5 a reset that leaves the ball below the floor, on its way up, misses no impact",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-6, 1e-8, 1e-10), depth = GENERATE(1e-15, 1e-9, 1e-6, 1e-3);
  constexpr double g = 10.0, e = 0.9;
  const Leaf ball("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({5.0, 0.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({-depth, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
  const auto results = simulate(ball, ball.create_context(), {0.0, 8.0},
                                {.rtol = rtol, .atol = 1e-2 * rtol, .ode_solver_method = method});
  INFO(method << ", rtol " << rtol << ", depth " << depth);
  // By energy: a reset at speed w and height 0 leaves e w at -depth, and the ball comes back to 0
  // with the speed sqrt(e^2 w^2 - 2 g depth).
  double w = 10.0, t = 1.0;
  std::vector<double> expected;
  while (t < 8.0) {
    expected.push_back(t);
    const double up = e * w;
    w = std::sqrt(up * up - 2.0 * g * depth);
    t += (up + w) / g;
  }
  const std::vector<double> times = results.events.times("bounce");
  REQUIRE(times.size() == expected.size());
  // The global error of five flights of the loosest multistep method is some hundred tolerances.
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK(std::abs(times[i] - expected[i]) < 1e3 * rtol);
}
