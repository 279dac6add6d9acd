// The decisions about relations, row by row of their tables.
#include "saltus/simulation/detail/relation_decisions.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("A relation that comes to exactly zero and turns back does not cross it") {
  const auto to = [](int side) { return [side] { return side; }; };
  const auto unasked = []() -> int { throw std::logic_error("the flow need not be asked"); };
  for (const int from : {1, -1}) {
    CHECK(only_touches(0.0, from, to(from)));
    CHECK(!only_touches(0.0, from, to(-from)));
    CHECK(!only_touches(0.0, from, to(0)));
    CHECK(!only_touches(-1e-300 * from, from, unasked));
  }
}

TEST_CASE(
    "A relation that is read again takes the side its value says, unless it was just crossed") {
  struct Reads {
    std::string name;
    RelationFacts facts;
    std::optional<int> expected;
  };
  const std::vector<Reads> table = {
      {"off zero, above", {.g = 1.0}, 1},
      {"off zero, below", {.truth = true, .g = -1.0}, -1},
      {"at zero it keeps its truth", {.truth = true, .g = 0.0}, 0},
      {"fired, nothing written: rounding says nothing",
       {.g = 1e-17, .fired = true, .came_from = 1},
       -1},
      {"fired, written: the flow decides",
       {.g = 1e-17, .fired = true, .came_from = 1, .wrote = true},
       {}},
      {"opaque, on the crossing's side",
       {.opaque = true, .g = -1.0, .fired = true, .came_from = 1, .wrote = true},
       -1},
      {"opaque, back on the other side",
       {.opaque = true, .g = 1.0, .fired = true, .came_from = 1, .wrote = true},
       {}},
      {"turned before, and at zero now", {.g = 0.0, .turned = true, .wrote = true}, {}},
      {"turned before, and at zero, but nothing written", {.g = 0.0, .turned = true}, 0},
      {"turned before, off zero now", {.g = 1.0, .turned = true, .wrote = true}, 1},
  };
  for (const Reads& row : table) {
    INFO(row.name);
    CHECK(decide_relation(row.facts) == row.expected);
    RelationFacts down = row.facts;  // the same upside down
    down.truth = !down.truth, down.g = -down.g, down.came_from = -down.came_from;
    const auto other = row.expected ? std::optional(-*row.expected) : std::nullopt;
    CHECK(decide_relation(down) == other);
  }
}

TEST_CASE("A relation that others put at zero, and that stays there, is what it says at zero") {
  const auto unasked = []() -> bool { throw std::logic_error("asked for the flow"); };
  const auto yes = [] { return true; };
  const auto no = [] { return false; };
  const bool at_zero = GENERATE(false, true);
  const int side = at_zero ? 1 : -1;
  const RelationFacts other{.truth = !at_zero, .g = 0.0};
  CHECK(decide_at_zero(other, 0, at_zero, yes) == side);
  CHECK(decide_at_zero(other, 0, at_zero, no) == 0);
  CHECK(decide_at_zero({.truth = at_zero, .g = 0.0}, 0, at_zero, unasked) == 0);
  CHECK(decide_at_zero({.truth = !at_zero, .g = 1e-300}, 1, at_zero, unasked) == 1);
  CHECK(decide_at_zero({.opaque = true, .truth = !at_zero}, 0, at_zero, unasked) == 0);
  CHECK(decide_at_zero({.truth = !at_zero, .fired = true}, -side, at_zero, unasked) == -side);
  CHECK(decide_at_zero({.truth = !at_zero, .wrote = true}, 0, at_zero, unasked) == 0);
}

TEST_CASE("How a relation goes on") {
  using enum RelationArming;
  CHECK(decide_relation_arming(true, 1, -1, true, true) == by_truth);
  CHECK(decide_relation_arming(false, 1, 1, false, false) == unchanged);
  CHECK(decide_relation_arming(false, 1, 1, false, true) == unchanged);
  CHECK(decide_relation_arming(false, 1, 1, true, true) == within_value);
  CHECK(decide_relation_arming(false, 0, 1, false, true) == within_value);
  CHECK(decide_relation_arming(false, 1, 1, true, false) == by_flow);
  CHECK(decide_relation_arming(false, 0, 1, false, false) == by_flow);
}

TEST_CASE("A relation at its zero follows the flow, and rests where the flow leads straight back") {
  const auto yes = [] { return true; };
  const auto no = [] { return false; };
  const auto unasked = []() -> bool { throw std::logic_error("asked for the flow before"); };
  const int to = GENERATE(-1, 1);
  CHECK(decide_relation_side(0, to, true, true, unasked) == RelationSide{to, false});
  CHECK(decide_relation_side(to, to, true, true, yes) == RelationSide{to, true});
  CHECK(decide_relation_side(to, to, true, true, no) == RelationSide{to, false});
  CHECK(decide_relation_side(to, to, true, false, unasked) == RelationSide{to, false});
  CHECK(decide_relation_side(to, to, false, true, unasked) == RelationSide{to, false});
  CHECK(decide_relation_side(-to, to, true, true, unasked) == RelationSide{-to, false});
}
