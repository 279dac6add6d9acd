// Root separation: a polynomial crosses zero at most once between two of the points.
#include "saltus/solver/detail/taylor/root_separation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "support/catch.hpp"

using saltus::taylor::RootSeparation;

namespace {

/// The coefficients of scale * prod (s - root), padded with zeros to the degree.
std::vector<double> from_roots(const std::vector<double>& roots, double scale, int degree) {
  std::vector<double> a(static_cast<std::size_t>(degree) + 1, 0.0);
  a[0] = scale;
  int known = 0;
  for (const double root : roots) {
    ++known;
    for (int i = known; i >= 0; --i) {
      const auto k = static_cast<std::size_t>(i);
      a[k] = (i > 0 ? a[k - 1] : 0.0) - root * a[k];
    }
  }
  return a;
}

double value(const std::vector<double>& a, double s) {
  double sum = 0.0;
  for (auto i = a.rbegin(); i != a.rend(); ++i) sum = sum * s + *i;
  return sum;
}

std::vector<double> points_of(const std::vector<double>& a, double from = 0.0) {
  std::vector<double> points;
  RootSeparation separation;
  REQUIRE(separation.separate(a.data(), static_cast<int>(a.size()) - 1, from, points));
  std::ranges::sort(points);
  return points;
}

/// The changes of sign of the polynomial at 0, the points and 1.
int changes(const std::vector<double>& a, const std::vector<double>& points) {
  int count = 0;
  double before = value(a, 0.0);
  std::vector<double> looks = points;
  looks.push_back(1.0);
  for (const double s : looks) {
    const double now = value(a, s);
    if (now * before < 0.0) ++count;
    if (now != 0.0) before = now;
  }
  return count;
}

}  // namespace

TEST_CASE("Looks at the points show each simple root of a polynomial in the step") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.001, 0.999), outside(1.05, 4.0);
  for (int count = 0; count <= 5; ++count) {
    for (int repeat = 0; repeat < 200; ++repeat) {
      std::vector<double> roots;
      for (int i = 0; i < count; ++i) roots.push_back(place(random));
      std::ranges::sort(roots);
      bool apart = true;  // a polynomial with roots nearer than this is zero there within rounding
      for (int i = 1; i < count; ++i)
        apart = apart &&
                roots[static_cast<std::size_t>(i)] - roots[static_cast<std::size_t>(i) - 1] > 2e-3;
      if (!apart) continue;
      for (int i = 0; i < 3; ++i)
        roots.push_back(repeat % 2 == 0 ? outside(random) : -outside(random));
      const auto a = from_roots(roots, 1.5, 15);
      CAPTURE(count, repeat);
      CHECK(changes(a, points_of(a)) == count);
    }
  }
}

TEST_CASE("A pair of roots is seen however near the two are, up to the rounding") {
  // (s - r)^2 - d^2 / 4 has its minimum -d^2 / 4 at r. Its coefficients are rounded to some 1e-16,
  // and the margin is below 2 * 15 * 2.2e-16 * 3.8 = 2.5e-14, so a depth of 2.5e-13 shows.
  for (const double apart : {1e-1, 1e-2, 1e-4, 1e-6}) {
    for (const double at : {0.06, 0.3, 0.5, 0.71, 0.94}) {
      auto a = from_roots({at, at}, 1.0, 15);
      a[0] -= 0.25 * apart * apart;
      CAPTURE(apart, at);
      CHECK(changes(a, points_of(a)) == 2);
    }
  }
}

TEST_CASE("A double root is looked at") {
  for (const double at : {0.1, 0.37, 0.5, 0.8}) {
    const auto points = points_of(from_roots({at, at}, 1.0, 12));
    // within the margin, 2e-14 here, around the root: its square root is 1.4e-7, and parts of the
    // step are halved until they are that short
    CAPTURE(at);
    CHECK(std::ranges::any_of(points, [&](double s) { return std::abs(s - at) < 1e-6; }));
  }
}

TEST_CASE("A guard that cannot reach zero has no points") {
  for (const auto& a :
       {std::vector{1.0, -0.4, 0.3, -0.1, 0.0, 0.0}, std::vector{-2.0, 1.0, 0.5, 0.1, 0.0, 0.0},
        from_roots({-0.5, -3.0, 1.5, 2.0}, 1.0, 12)})
    CHECK(points_of(a).empty());
}

TEST_CASE("A crossing at a point where the step is cut counts as any other") {
  for (const auto& roots : {std::vector{0.25, 0.35}, std::vector{0.15, 0.25},
                            std::vector{0.25, 0.5, 0.75}, std::vector{0.125, 0.1875, 0.5, 0.625}}) {
    const auto a = from_roots(roots, 1.0, 12);
    CHECK(changes(a, points_of(a)) == static_cast<int>(roots.size()));
  }
}

TEST_CASE("A single crossing needs no point, nor does a flight that begins on zero and goes on") {
  CHECK(points_of(from_roots({0.4}, 1.0, 12)).empty());
  CHECK(points_of({0.0, 3.0, -1.0, 0.0, 0.0, 0.0}).empty());
  CHECK(points_of({1e-17, 3.0, -1.0, 0.0, 0.0, 0.0}).empty());
}

TEST_CASE("A flight that begins on zero and ends beyond it is looked at in between") {
  CHECK(points_of({0.0, 3.0, -4.0, 0.0, 0.0, 0.0}) == std::vector{0.5});
}

TEST_CASE("Roots before the part that is searched add no point of it") {
  const auto a = from_roots({0.1, 0.2, 0.3, 0.9}, 1.0, 12);
  for (const double s : points_of(a, 0.5)) CHECK(s > 0.5);
  CHECK(changes(a, points_of(a)) == 4);
}

TEST_CASE("A series that does not converge within the step leaves its roots open") {
  std::vector<double> a(16), points;
  std::iota(a.begin(), a.end(), 1.0);
  RootSeparation separation;
  CHECK_FALSE(separation.separate(a.data(), 15, 0.0, points));
  a.assign(16, 0.0), a[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(separation.separate(a.data(), 15, 0.0, points));
}

TEST_CASE("A series whose later terms are small shows its roots") {
  RootSeparation separation;
  const auto shows = [&](double late) {
    std::vector<double> a(16, 0.0), points;
    a[0] = 0.5, a[1] = -1.0, a[12] = late;
    return separation.separate(a.data(), 15, 0.0, points);
  };
  CHECK(shows(0.0));
  CHECK(shows(1e-4));
  CHECK_FALSE(shows(1e-2));
  CHECK_FALSE(shows(0.5));
}
