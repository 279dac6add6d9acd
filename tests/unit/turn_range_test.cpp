// TurnRange: where the parabola through three looks may turn.
#include "saltus/solver/detail/turn_range.hpp"

#include "support/catch.hpp"

using namespace saltus;

namespace {

/// Whether the range contains the vertex of (u - vertex)^2, after looks at u = -before, 0 and 1.
bool contains(double vertex, double before, bool goes_back, bool ends) {
  const auto g = [&](double u) { return (u - vertex) * (u - vertex); };
  return TurnRange(1.0 / before, goes_back, ends).contains(g(0.0) - g(-before), g(1.0) - g(0.0));
}

}  // namespace

TEST_CASE("a range is the part that is searched, and a piece more at an end", "[turn_range]") {
  for (const double before : {0.3, 1.0, 4.0}) {
    struct Row {
      bool goes_back, ends;
      double from, to;
    };
    for (const Row& row : {Row{true, false, -before, 1.0},
                           {true, true, -before, 2.0},
                           {false, false, -1.0, 1.0},
                           {false, true, -1.0, 2.0}}) {
      CAPTURE(before, row.goes_back, row.ends);
      for (const double inside : {row.from + 0.01, 0.5 * (row.from + row.to), row.to - 0.01})
        CHECK(contains(inside, before, row.goes_back, row.ends));
      for (const double outside : {row.from - 0.01, row.to + 0.01})
        CHECK_FALSE(contains(outside, before, row.goes_back, row.ends));
    }
  }
}

TEST_CASE("a hill and a line turn nowhere", "[turn_range]") {
  for (const bool goes_back : {true, false})
    for (const bool ends : {true, false}) {
      CHECK_FALSE(TurnRange(1.0, goes_back, ends).contains(1.0, -1.0));
      CHECK_FALSE(TurnRange(1.0, goes_back, ends).contains(-1.0, -1.0));
      CHECK_FALSE(TurnRange(1.0, goes_back, ends).contains(0.0, 0.0));
    }
}
