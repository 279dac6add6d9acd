// MajorSteps: stops counted from the last instant; a stop within rounding of another is that one.
#include "saltus/simulation/detail/major_steps.hpp"
#include "support/leaves.hpp"

using namespace saltus;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The stops from `from` to `end`.
std::vector<double> stops(double length, double from, double end) {
  MajorSteps major(length);
  major.begin(from);
  std::vector<double> found;
  for (double t = from; t < end; found.push_back(t)) t = major.next(t, end);
  return found;
}

}  // namespace

TEST_CASE("steps are counted: n lengths are n steps, wherever they begin", "[major_steps]") {
  for (const double length : {0.1, 1.0 / 3.0, 1e-3, 0.7}) {
    for (const double from : {0.0, 0.1, -3.3, 1e6}) {
      const auto found = stops(length, from, from + 1000.0 * length);
      CHECK(found.size() == 1000);
      CHECK(found.back() == from + 1000.0 * length);
    }
  }
}

TEST_CASE("without a length the next stop is the other one", "[major_steps]") {
  CHECK(MajorSteps(never).next(2.0, 7.0) == 7.0);
  CHECK(MajorSteps(never).next(2.0, never) == never);
}

TEST_CASE("a stop of something else comes first, and is the same if a rounding apart",
          "[major_steps]") {
  const MajorSteps major(0.1);
  CHECK(major.next(0.0, 0.05) == 0.05);
  CHECK(major.next(0.05, 7.0) == 0.1);
  const double near = std::nextafter(0.1, 1.0);
  CHECK(major.next(0.05, near) == near);
  CHECK(major.next(near, 7.0) == 0.2);
  CHECK(major.next(std::nextafter(0.1, 0.0), 7.0) == 0.2);
}

TEST_CASE("a length below the rounding of the time still advances", "[major_steps]") {
  MajorSteps major(1e-20);
  major.begin(1.0);
  CHECK(major.next(1.0, 2.0) > 1.0);
}
