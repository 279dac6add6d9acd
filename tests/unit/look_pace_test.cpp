// LookPace: how far apart the looks at a guard may be.
#include "saltus/solver/detail/look_pace.hpp"

#include <cmath>

#include "saltus/solver/detail/third_difference.hpp"
#include "support/catch.hpp"

using namespace saltus;

namespace {

/// A sine with four looks, the last at its angle, and `apart` between each two.
LookVariation of_sine(double angle, double apart, double above = 1.0) {
  double g[4];
  for (int i = 0; i < 4; ++i) g[i] = above + std::sin(angle - (3 - i) * apart);
  const ThirdDifference bound(0.0, apart, 2.0 * apart, 3.0 * apart);
  const auto [low, high] = std::minmax({g[0], g[1], g[2], g[3]});
  const bool crosses = (g[2] > 0.0) != (g[3] > 0.0);
  return {std::abs(bound.of(g[0], g[1], g[2], g[3])), high - low,
          crosses ? 0.0 : std::min(std::abs(g[2]), std::abs(g[3]))};
}

/// Whether some sine with looks so far apart seems to hide something.
bool some_hides(double apart) {
  bool hides = false;
  for (double angle = 0.0; angle < 6.3; angle += 0.01) hides |= of_sine(angle, apart).hides();
  return hides;
}
bool each_is_slow(double apart) {
  bool slow = true;
  for (double angle = 0.0; angle < 6.3; angle += 0.01) slow &= of_sine(angle, apart).is_slow();
  return slow;
}

}  // namespace

TEST_CASE("twelve looks in a period of a sine show it, four do not", "[look_pace]") {
  const double period = 2.0 * std::acos(-1.0);
  CHECK_FALSE(some_hides(period / 12.0));
  CHECK(some_hides(period / 4.0));
}

TEST_CASE("a guard that is further from zero than it may have moved hides nothing", "[look_pace]") {
  const LookVariation hidden{.error = 1.0, .range = 2.0, .least = 3.9};
  const LookVariation far{.error = 1.0, .range = 2.0, .least = 4.1};
  const LookVariation jump{.error = 1.0, .range = 2.0, .least = 1.0, .jumps_once = true};
  CHECK(hidden.hides());
  CHECK_FALSE(far.hides());
  CHECK_FALSE(jump.hides());
}

TEST_CASE("where a piece is slow, one of twice the length hides nothing", "[look_pace]") {
  bool found = false;
  for (double apart = 0.02; apart < 2.0; apart *= 1.05) {
    if (!each_is_slow(apart)) continue;
    found = true;
    INFO("apart " << apart);
    CHECK_FALSE(some_hides(2.0 * apart));
  }
  CHECK(found);
}

TEST_CASE("a piece that hides something is halved, and grows again where the guard is slow",
          "[look_pace]") {
  LookPace pace;
  CHECK_FALSE(pace.is_finer_than(1.0));
  CHECK(pace.next(1.0) == 1.0);
  REQUIRE(pace.halve(1.0, 0.01));
  CHECK(pace.is_finer_than(1.0));
  CHECK(pace.next(1.0) == 0.5);
  REQUIRE(pace.halve(0.5, 0.01));
  CHECK(pace.next(1.0) == 0.25);
  pace.accept(0.25, false);
  CHECK(pace.next(1.0) == 0.25);
  pace.accept(0.25, true);
  CHECK(pace.next(1.0) == 0.5);
  // A short rest of a piece makes no piece shorter.
  pace.accept(0.01, true);
  CHECK(pace.next(1.0) == 0.5);
}

TEST_CASE("a long step after short ones has no more pieces than allowed", "[look_pace]") {
  LookPace pace;
  REQUIRE(pace.halve(1e-9, 1e-12));
  CHECK(pace.begin_step(1.0, 0.125));
  CHECK(pace.next(1.0) == 0.125);
  CHECK_FALSE(pace.begin_step(1.0, 0.125));  // not the first of the run
  CHECK_FALSE(pace.halve(0.2, 0.125));
}

TEST_CASE("a step is as the first of a run where its looks are much further apart than any before",
          "[look_pace]") {
  LookPace pace;
  CHECK(pace.begin_step(1.0, 0.01));
  CHECK_FALSE(pace.begin_step(0.1, 0.01));
  CHECK_FALSE(pace.begin_step(8.0, 0.01));
  CHECK(pace.begin_step(8.1, 0.01));
  CHECK_FALSE(pace.begin_step(60.0, 0.01));
}

TEST_CASE("the pieces of an interval are even, and no rounding adds one", "[look_pace]") {
  LookPace pace;
  REQUIRE(pace.halve(0.6, 0.01));  // to 0.3
  CHECK(pace.next(1.0) == 0.25);
  CHECK(pace.next(0.3 * (1.0 + 1e-15)) == 0.3 * (1.0 + 1e-15));
}

TEST_CASE("a guard that no piece shows is left out for some steps", "[look_pace]") {
  Judged judged;
  for (int i = 0; i < thresholds::most_in_vain; ++i) judged.fail();
  CHECK(judged.yes());
  judged.begin_step();  // a few in each step are no reason
  for (int i = 0; i < thresholds::most_in_vain; ++i) judged.fail();
  CHECK(judged.yes());
  judged.fail();
  int steps = 0;
  for (; !judged.yes(); ++steps) judged.begin_step();
  CHECK(steps == thresholds::most_patience);
}

TEST_CASE("a guard that seems to be noise again and again is left out", "[look_pace]") {
  Judged judged;
  for (int i = 0; i < thresholds::most_in_vain; ++i) judged.note(true);
  CHECK(judged.yes());
  judged.note(false);  // one piece shows the guard: it is smooth
  for (int i = 0; i < thresholds::most_in_vain; ++i) judged.note(true);
  CHECK(judged.yes());
  judged.note(true);
  CHECK_FALSE(judged.yes());
}

TEST_CASE("where a guard follows the time, a step passes if one half as long was looked into",
          "[look_pace]") {
  LookPace pace;
  CHECK_FALSE(pace.shows(1.0));  // nothing is known
  pace.see(1.0);
  CHECK(pace.shows(1.0));
  CHECK(pace.shows(0.1));
  CHECK(pace.shows(2.0));
  CHECK_FALSE(pace.shows(2.1));
  pace.see(0.4);  // only the last one counts: the guard may be faster by now
  CHECK_FALSE(pace.shows(1.0));
  pace.see(1.0);
  REQUIRE(pace.halve(0.4, 0.01));  // to looks 0.2 apart
  CHECK_FALSE(pace.shows(0.3));
  CHECK(pace.shows(0.2));
}

TEST_CASE("looks after a restart, or as far apart as the even ones, do not show such a guard",
          "[look_pace]") {
  LookPace pace;
  CHECK(pace.is_doubtful(0.2, true));
  CHECK(pace.is_doubtful(0.2, false));
  REQUIRE(pace.halve(0.2, 0.01));
  CHECK(pace.is_doubtful(0.2, true));
  CHECK_FALSE(pace.is_doubtful(0.2, false));
}
