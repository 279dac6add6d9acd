// The decisions at the begin of an instant and after its passes, row by row of their tables.
#include "saltus/simulation/detail/pass_decisions.hpp"

#include <limits>

#include <stdexcept>

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("a guard beside the root of another one has crossed only where the flow takes it back") {
  const auto direction =
      GENERATE(Direction::positive_then_non_positive, Direction::negative_then_non_negative);
  const int armed_side = -firing_side(direction);
  const auto crossed = [&](Phase phase, int flow_to) {
    return crossed_beside_root(direction, phase, [&] { return flow_to; });
  };
  CHECK(crossed(Phase::armed, armed_side));
  CHECK_FALSE(crossed(Phase::armed, -armed_side));
  CHECK_FALSE(crossed(Phase::armed, 0));
  const auto unasked = []() -> int { throw std::logic_error("asked for the flow"); };
  for (const Phase phase : {Phase::unseen, Phase::waiting, Phase::resting, Phase::carried})
    CHECK_FALSE(crossed_beside_root(direction, phase, unasked));
}

TEST_CASE(
    "a guard beside the root of another one is on its armed side only if the flow takes it there") {
  const auto direction =
      GENERATE(Direction::positive_then_non_positive, Direction::negative_then_non_negative);
  const int firing = firing_side(direction);
  CHECK(side_beside_root(direction, -firing) == -firing);
  CHECK(side_beside_root(direction, firing) == firing);
  CHECK(side_beside_root(direction, 0) == firing);
}

TEST_CASE("a guard that fired has a side only beyond its error") {
  for (const double sign : {-1.0, 1.0}) {
    CHECK(side_after_firing(sign * 1e-9, 1e-12) == sign);
    CHECK(side_after_firing(sign * 1e-12, 1e-12) == 0);
    CHECK(side_after_firing(sign * 1e-300, 0.0) == sign);
  }
  CHECK(side_after_firing(0.0, 0.0) == 0);
}

TEST_CASE("a guard crosses at a stop by its value, by the flow a rounding later, or by its side") {
  const auto unasked = []() -> int { throw std::logic_error("asked for the flow"); };
  const auto to = [](int side) { return [side] { return side; }; };
  for (const int side : {-1, 1}) {
    Guard guard;
    guard.set(Phase::armed, side, 0.0);
    CHECK(crosses_at_stop(guard, 0.0, side, 0.0, unasked));    // it is there
    CHECK(crosses_at_stop(guard, side, -side, 0.0, unasked));  // it is there a rounding later
    CHECK_FALSE(crosses_at_stop(guard, side, side, 0.5, unasked));
    CHECK(crosses_at_stop(guard, 0.4 * side, side, 0.5, to(-side)));
    CHECK_FALSE(crosses_at_stop(guard, 0.4 * side, side, 0.5, to(side)));
    CHECK_FALSE(crosses_at_stop(guard, 0.4 * side, side, 0.5, to(0)));
    guard.direction = side > 0 ? Direction::negative_then_non_negative
                               : Direction::positive_then_non_positive;  // not its direction
    CHECK_FALSE(crosses_at_stop(guard, 0.4 * side, side, 0.5, unasked));
    guard.direction = Direction::edge_detection;
    guard.base = side;
    CHECK_FALSE(crosses_at_stop(guard, side, side, 2.0, unasked));
    CHECK(crosses_at_stop(guard, side, -side, 0.0, unasked));
    for (const Phase phase : {Phase::unseen, Phase::waiting, Phase::resting, Phase::carried}) {
      guard.set(phase, side, 0.0);
      CHECK_FALSE(crosses_at_stop(guard, 0.0, -side, 1.0, unasked));
    }
  }
}

TEST_CASE("a guard that jumped at a root came back only if it is off zero, on its side before") {
  for (const double size : {1.0, 1e-300, 1e300}) {
    CHECK(came_back(1, size));
    CHECK(came_back(-1, -size));
    CHECK_FALSE(came_back(1, -size));
    CHECK_FALSE(came_back(-1, size));
  }
  CHECK_FALSE(came_back(1, 0.0));
  CHECK_FALSE(came_back(-1, 0.0));
  CHECK_FALSE(came_back(1, std::numeric_limits<double>::quiet_NaN()));
}

TEST_CASE("after a pass a guard is looked at, seen, or left to its hold") {
  const bool queued = GENERATE(false, true);
  CHECK(decide_after_pass(true, true, queued) == AfterPass::nothing);
  CHECK(decide_after_pass(true, false, queued) == AfterPass::look_at_hold);
  CHECK(decide_after_pass(false, false, queued) == AfterPass::look);
  CHECK(decide_after_pass(false, true, false) == AfterPass::see);
  CHECK(decide_after_pass(false, true, true) == AfterPass::see_behind);
}

TEST_CASE("a commit that leaves a thousandth of its way beyond zero has put the guard there") {
  const double way = GENERATE(1.0, -1.0, 1e-200, 1e200);
  CHECK(stops_near_zero(way, 0.0));
  CHECK(stops_near_zero(way, -1e-4 * way));
  CHECK(stops_near_zero(way, 1e-4 * way));
  CHECK_FALSE(stops_near_zero(way, -1e-2 * way));
  CHECK_FALSE(stops_near_zero(way, -way));
  CHECK_FALSE(stops_near_zero(way, way));
}

TEST_CASE("a commit moves a guard off zero only beyond where it was, and beyond its uncertainty") {
  const double before = 1e-15, uncertainty = 1e-16;
  for (const double sign : {-1.0, 1.0}) {
    CHECK_FALSE(moves_off_zero(before, sign * before, uncertainty));  // not moved, or mirrored
    CHECK_FALSE(moves_off_zero(before, sign * 0.5 * before, uncertainty));
    CHECK(moves_off_zero(before, sign * 2.0 * before, uncertainty));
    CHECK_FALSE(moves_off_zero(0.0, sign * uncertainty, uncertainty));
    CHECK(moves_off_zero(0.0, sign * 2.0 * uncertainty, uncertainty));
  }
  CHECK_FALSE(moves_off_zero(0.0, 0.0, 0.0));
}

TEST_CASE("a guard's value is uncertain by its rounding, and by its slope times that of the time") {
  using namespace saltus::thresholds;
  CHECK(value_uncertainty(0.0, 0.0, 5.0) == 0.0);
  CHECK(value_uncertainty(1e-15, 0.0, 5.0) == 1e-15);
  CHECK(value_uncertainty(0.0, 3.0, 0.0) == 0.0);
  const double slope = GENERATE(-2.0, 2.0), t = GENERATE(-4.0, 4.0);  // powers of two: exact
  CHECK(value_uncertainty(0.0, slope, t) == 8.0 * location_roundings * eps);
}

TEST_CASE("the flow is asked about a root only where it may be rounding") {
  const RootFacts rounding{.armed_at_zero = true, .at_zero = true};
  const RootFacts opaque{.armed_at_zero = true, .opaque = true};  // its values are only signs
  const RootFacts soon{.soon = true};
  CHECK_FALSE(may_be_rounding({}));
  CHECK_FALSE(may_be_rounding({.armed_at_zero = true}));  // a true root
  for (const RootFacts& facts : {rounding, opaque}) {
    CHECK(may_be_rounding(facts));
    RootFacts never_waited = facts;
    never_waited.armed_at_zero = false;
    CHECK_FALSE(may_be_rounding(never_waited));
  }
  for (RootFacts facts : {rounding, opaque, soon}) {
    CHECK(may_be_rounding(facts));
    RootFacts other = facts;
    other.monitor = true;
    CHECK_FALSE(may_be_rounding(other));
    other = facts, other.edge = true;
    CHECK_FALSE(may_be_rounding(other));
  }
}
