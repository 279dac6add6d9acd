// The calls that impacts at one instant do not cost: their guards leave zero by one flight.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// n balls that fall from one height, y'' = -9.81, e = 0.9, and land together.
Leaf balls(Index n, const std::string& name = "balls") {
  return Leaf(name, [&](Leaf& l) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * n);
    start.head(n).setConstant(10.0);
    l.declare_continuous_state({.initial = start, .ode = [n](const At& at, VectorRef xdot) {
                                  xdot.head(n) = at.x.tail(n), xdot.tail(n).setConstant(-9.81);
                                }});
    l.declare_zero_crossing({.name = "bounce",
                             .guard = [n](const At& at, VectorRef out) { out = at.x.head(n); },
                             .reset_map =
                                 [n](const At& at, Next& next) {
                                   Eigen::VectorXd x = at.x;
                                   x[at.entry] = std::abs(x[at.entry]), x[n + at.entry] *= -0.9;
                                   next.set_continuous_state(x);
                                 },
                             .direction = Direction::positive_then_non_positive,
                             .size = n});
  });
}

Statistics of(const System& system) {
  const Results results =
      simulate(system, system.create_context(), {0.0, 10.0},
               {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5});
  return results.statistics;
}

}  // namespace

// Equal balls have the error norms of one ball, so the steps are the same: what is left are the calls
// in the instants. One flight after the resets shows the side of all guards, and one look at a
// group that of all its entries.
TEST_CASE("impacts at one instant call the derivative as often as one impact", "[absent]") {
  const Statistics one = of(balls(1)), many = of(balls(20));
  REQUIRE(one.events == 4);
  CHECK(many.events == 20 * one.events);
  CHECK(many.steps == one.steps);
  CHECK(many.right_hand_side_calls == one.right_hand_side_calls);
  // Where there are several guards, the part of a step before a root has four looks of its own.
  CHECK(many.guard_calls <= one.guard_calls + 4 * one.events);
}

TEST_CASE("impacts of many leaves at one instant call the derivative as often as one impact",
          "[absent]") {
  DiagramBuilder builder;
  for (int i = 0; i < 20; ++i) builder.add(std::make_shared<Leaf>(balls(1, text("ball_", i))));
  const Statistics one = of(balls(1)), many = of(builder.build("balls"));
  CHECK(many.events == 20 * one.events);
  CHECK(many.right_hand_side_calls == one.right_hand_side_calls);
}
