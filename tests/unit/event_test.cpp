// The table of directions: when a guard that was on one side fires.
#include "saltus/solver/detail/guard.hpp"
#include "support/run.hpp"

using namespace saltus;

TEST_CASE("each direction fires in its cells of the table and in no other", "[event]") {
  struct Row {
    Direction direction;
    bool fires[2][3];  // armed on +1, -1; now -1, 0, +1
  };
  const Row table[] = {
      {Direction::none, {{false, false, false}, {false, false, false}}},
      {Direction::crosses_zero, {{true, true, false}, {false, true, true}}},
      {Direction::positive_then_non_positive, {{true, true, false}, {false, false, false}}},
      {Direction::negative_then_non_negative, {{false, false, false}, {false, true, true}}},
      {Direction::edge_detection, {{true, true, false}, {false, true, true}}}};
  for (const Row& row : table) {
    for (int side : {1, -1}) {
      for (int now : {-1, 0, 1}) {
        INFO(to_string(row.direction) << " armed on " << side << ", now " << now);
        CHECK(fires(row.direction, side, now) == row.fires[side > 0 ? 0 : 1][now + 1]);
      }
    }
  }
}

TEST_CASE("a guard without a side fires in no direction but edge detection", "[event]") {
  for (const Direction direction :
       {Direction::none, Direction::crosses_zero, Direction::positive_then_non_positive,
        Direction::negative_then_non_negative}) {
    for (int now : {-1, 0, 1}) CHECK(!fires(direction, 0, now));
  }
}

TEST_CASE("every direction has a name, and a name its direction", "[event]") {
  for (const auto& [name, direction] : direction_names) {
    CHECK(to_string(direction) == name);
    CHECK(direction_from(name) == direction);
  }
  CHECK(support::contains(support::message<ModelError>([] { direction_from("crosses zero"); }),
                          "unknown direction 'crosses zero'; did you mean 'crosses_zero'?"));
}

TEST_CASE("signs are compared, so the smallest and the largest numbers have one", "[event]") {
  Guard guard;
  guard.phase = Phase::armed, guard.side = 1;
  CHECK(guard.crossed(-5e-324));
  CHECK(guard.crossed(0.0));
  CHECK(guard.crossed(-0.0));
  CHECK(!guard.crossed(5e-324));
  CHECK(guard.crossed(-1e308));
  CHECK(!guard.crossed(1e308));
}
