// An event of one island asks nothing of another: the calls of a scene are the sum of the calls of
// its parts, and an island at rest costs as much as alone.
#include "support/islands.hpp"

using namespace saltus;
using namespace support;

namespace {

/// n balls, a leaf each, which start at heights that differ: no two bounce at one time.
Diagram balls(int n) {
  DiagramBuilder builder;
  for (int i = 0; i < n; ++i)
    builder.add(std::make_shared<Ball>(BallOptions{.e = 0.9}, text("ball_", i)));
  return builder.build();
}

Statistics of(int n, bool islands) {
  const Diagram scene = balls(n);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * n);
  for (int i = 0; i < n; ++i) x[2 * i] = 1.0 + 0.01 * i;
  const Context start = scene.create_context().with_continuous_state(x);
  return simulate(scene, start, {0.0, 3.0}, {.islands = islands}).statistics;
}

}  // namespace

TEST_CASE("an event of one island asks nothing of another", "[absent][islands]") {
  int calls = 0, guards = 0;
  const auto still = make_leaf("still", [&](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [&](const At& at) {
                                  ++calls;
                                  return -at.x[0];
                                }});
    l.declare_zero_crossing({.name = "never", .guard = [&](const At& at) {
                               ++guards;
                               return at.x[0] + 1.0;
                             }});
  });
  DiagramBuilder builder;
  builder.add(still);
  const Diagram alone = builder.build();
  simulate(alone, alone.create_context(), {0.0, 3.0}, {});
  const int calls_alone = std::exchange(calls, 0), guards_alone = std::exchange(guards, 0);
  REQUIRE(calls_alone > 0);
  DiagramBuilder both;
  both.add(still);
  both.add(std::make_shared<Ball>(BallOptions{}, "ball"));
  const Diagram scene = both.build();
  const Context start = scene.create_context().with_continuous_state(vec({1.0, 1.0, 0.0}));
  const Results results = simulate(scene, start, {0.0, 3.0}, {.islands = true});
  REQUIRE(results.events.size() > 3);
  CHECK(calls == calls_alone);
  CHECK(guards == guards_alone);
}

TEST_CASE("n balls have n times the calls of one ball", "[absent][islands]") {
  const Statistics one = of(1, true), ten = of(10, true), hundred = of(100, true);
  // Higher balls fly longer and bounce less often, so the counts are not exactly n times those of
  // the lowest ball: no ball has more events, and each has some.
  CHECK(ten.right_hand_side_calls <= 10 * one.right_hand_side_calls + 10 * 8);
  CHECK(hundred.right_hand_side_calls <= 100 * one.right_hand_side_calls + 100 * 8);
  CHECK(hundred.steps <= 100 * one.steps + 100 * 2);
  // With a common step each event cuts the step of all: the calls of each leaf are those of all.
  CHECK(100 * of(100, false).right_hand_side_calls > 10 * hundred.right_hand_side_calls);
}
