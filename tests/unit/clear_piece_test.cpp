// ClearPiece: a sufficient test that nothing happens between the last two of four looks.
#include "saltus/solver/detail/clear_piece.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "support/catch.hpp"

using namespace saltus;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr ClearPiece even({1.0, true, true}, {0.0, 1.0, 2.0, 3.0});

/// Whether a guard with these values at the times 0, 1, 2 and 3 passes.
bool passes(const std::function<double(double)>& g, double side = 1.0) {
  return even.passes(side, g(0.0), g(1.0), g(2.0), g(3.0));
}

}  // namespace

TEST_CASE("a guard that falls slowly and stays on its side is clear", "[clear_piece]") {
  CHECK(passes([](double u) { return 10.0 - u; }));
  CHECK(passes([](double u) { return u - 10.0; }, -1.0));
  CHECK(passes([](double u) { return 20.0 - u * u; }));
}

TEST_CASE("a guard that crosses, touches zero or has no side is not clear", "[clear_piece]") {
  CHECK_FALSE(passes([](double u) { return 2.5 - u; }));
  CHECK_FALSE(passes([](double u) { return 3.0 - u; }));
  CHECK_FALSE(passes([](double u) { return 10.0 - u; }, 0.0));
  CHECK_FALSE(passes([](double u) { return 10.0 - u; }, -1.0));
}

TEST_CASE("a value that is not finite is not clear", "[clear_piece]") {
  for (const double bad : {infinite, -infinite, not_a_number}) {
    CAPTURE(bad);
    for (const double side : {1.0, -1.0}) {
      CHECK_FALSE(even.passes(side, 8.0 * side, 8.0 * side, 8.0 * side, bad));
      CHECK_FALSE(even.passes(side, 8.0 * side, 8.0 * side, bad, 8.0 * side));
      CHECK_FALSE(ClearPiece().passes(side, 8.0 * side, 8.0 * side, 8.0 * side, bad));
    }
  }
}

TEST_CASE("a guard that turns towards its side near the piece is not clear", "[clear_piece]") {
  for (const double vertex : {1.5, 2.0, 2.5, 3.5}) {
    CAPTURE(vertex);
    CHECK_FALSE(passes([&](double u) { return 1.0 + (u - vertex) * (u - vertex); }));
  }
}

// The exact tests of a piece are Variation::hides and TurnRange. What passes here passes them: for
// sines of any phase, height and period, which the parabola shows well or badly.
TEST_CASE("a clear piece hides nothing by the exact tests", "[clear_piece]") {
  int clear = 0, hidden = 0;
  for (double rate = 0.05; rate < 7.0; rate *= 1.3)
    for (double phase = 0.0; phase < 6.3; phase += 0.3)
      for (const double height : {0.0, 0.5, 0.9, 1.01, 2.0}) {
        double g[4];
        for (int i = 0; i < 4; ++i) g[i] = height + std::sin(rate * i + phase);
        const double error =
            std::abs(ThirdDifference(0.0, 1.0, 2.0, 3.0).of(g[0], g[1], g[2], g[3]));
        const double least = g[2] > 0.0 && g[3] > 0.0 ? std::min(g[2], g[3]) : 0.0;
        const bool hides = thresholds::hidden_room * error > least;
        const bool passed = even.passes(1.0, g[0], g[1], g[2], g[3]);
        clear += passed, hidden += hides;
        if (passed) {
          CHECK_FALSE(hides);
          CHECK((g[2] > 0.0 && g[3] > 0.0));
          CHECK_FALSE(TurnRange(1.0, true, true).contains(g[2] - g[1], g[3] - g[2]));
        }
      }
  CHECK(clear > 100);
  CHECK(hidden > 100);
}
