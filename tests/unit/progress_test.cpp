// Progress: steps so short that the time hardly advances.
#include "saltus/solver/detail/progress.hpp"

#include "support/catch.hpp"

using saltus::Progress, saltus::thresholds::eps;

namespace {

constexpr double t = 3.0;  // [s] its rounding is eps t, not that of a power of two

/// A step of a state that changes with each one.
bool stops(Progress& progress, double time, double length) {
  static double x = 0.0;
  return ++x, progress.stops_at(time, length, &x, 1);
}

/// The number of steps of this length after which progress ends; 0 if it does not within ten
/// thousand.
int steps_until_stop(double length) {
  Progress progress;
  for (int step = 1; step <= 10'000; ++step) {
    if (stops(progress, t, length)) return step;
  }
  return 0;
}

}  // namespace

TEST_CASE("steps of less than a rounding of the time stop a run after some tens to some hundreds") {
  // A jump of a stiff solution takes a dozen steps of a few roundings, and a pole takes thousands.
  for (const double length : {0.0, 0.01 * eps * t, 0.5 * eps * t}) {
    INFO("length " << length);
    const int steps = steps_until_stop(length);
    CHECK(steps >= 20);
    CHECK(steps <= 1000);
  }
}

TEST_CASE("steps of a few roundings of the time advance it, however many there are") {
  for (const double roundings : {2.0, 10.0, 100.0})
    CHECK(steps_until_stop(roundings * eps * t) == 0);
}

TEST_CASE("one step that advances the time begins the count anew") {
  Progress progress;
  bool stopped = false;
  for (int step = 0; step < 2000; ++step)
    stopped = stopped || stops(progress, t, step % 15 == 0 ? 1e-3 : 0.0);
  CHECK_FALSE(stopped);
}

TEST_CASE("at t = 0 only steps of no length stop a run") {
  Progress progress;
  for (int step = 0; step < 2000; ++step) REQUIRE_FALSE(stops(progress, 0.0, 1e-300));
}

TEST_CASE("steps of a few roundings of the time stop a run whose state does not change") {
  Progress progress;
  const double still[] = {5.0, -1.0};
  int step = 0;
  while (!progress.stops_at(t, 4.0 * eps * t, still, 2)) REQUIRE(++step < 1000);
  CHECK(step >= 20);
}
