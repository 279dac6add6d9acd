// ThirdDifference: the bound of the error of a parabola, from a fourth look.
#include "saltus/solver/detail/third_difference.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "support/catch.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Looks {
  double u[4];
  double bound(const std::function<double(double)>& g) const {
    return ThirdDifference(u[0], u[1], u[2], u[3]).of(g(u[0]), g(u[1]), g(u[2]), g(u[3]));
  }
  /// The difference between g and the parabola through its last three looks (Lagrange's form).
  double error(const std::function<double(double)>& g, double at) const {
    double sum = 0.0;
    for (int i = 1; i < 4; ++i) {
      double weight = 1.0;
      for (int j = 1; j < 4; ++j)
        if (j != i) weight *= (at - u[j]) / (u[i] - u[j]);
      sum += weight * g(u[i]);
    }
    return std::abs(g(at) - sum);
  }
};

const Looks looks[] = {{{0.0, 1.0, 2.0, 3.0}}, {{-5.0, 0.0, 0.1, 0.3}}, {{0.0, 0.9, 1.0, 4.0}}};

}  // namespace

TEST_CASE("a parabola has no third difference", "[third_difference]") {
  for (const Looks& each : looks) {
    // Rounding of values below 100, of which four have weights below 30.
    CHECK_THAT(each.bound([](double u) { return 3.0 - u + 4.0 * u * u; }),
               WithinAbs(0.0, 4.0 * 30.0 * 100.0 * eps));
  }
}

TEST_CASE("the bound of a cubic is (u3 - u1) (u3 - u2)^2 / 4, and holds between the last two looks",
          "[third_difference]") {
  const auto cube = [](double u) { return u * u * u; };
  for (const Looks& each : looks) {
    const double h = each.u[3] - each.u[2], bound = each.bound(cube);
    CHECK_THAT(bound, WithinRel(0.25 * h * h * (each.u[3] - each.u[1]), 1e-10));
    double worst = 0.0;
    for (int i = 1; i < 64; ++i)
      worst = std::max(worst, each.error(cube, each.u[2] + h * i / 64.0));
    CHECK(worst <= bound);
    CHECK(worst > 0.5 * bound);
  }
}

TEST_CASE("lengths whose cubes are out of range make no difference", "[third_difference]") {
  const auto cube = [](double u) { return u * u * u; };
  const double one = Looks{{0.0, 1.0, 2.0, 3.0}}.bound(cube);
  for (const double size : {1e-150, 1e150}) {
    const Looks scaled{{0.0, size, 2.0 * size, 3.0 * size}};
    CHECK_THAT(scaled.bound([=](double u) { return cube(u / size); }), WithinRel(one, 1e-12));
  }
}
