// GuardPolynomials: guards as polynomials between two looks, their error, and their roots.
#include "saltus/solver/detail/guard_polynomials.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "support/catch.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double eps = thresholds::eps;
using Function = std::function<double(double)>;

/// The polynomial of one guard on [from, to].
struct One {
  explicit One(const Function& g, double from = 0.0, double to = 1.0) {
    polynomials.begin(from, to, {g(from)}, {g(to)});
    for (int j = 1; j < GuardPolynomials::degree; ++j)
      polynomials.values(j)[0] = g(polynomials.point(j));
  }
  GuardPolynomials::Error error() const { return polynomials.error(0); }
  /// The first point at which the guard is on the other side.
  int first() const {
    int j = 1;
    while (polynomials.value(j, 0) * polynomials.value(0, 0) > 0.0) ++j;
    return j;
  }
  std::optional<double> crossing(double room) const {
    return polynomials.crossing(0, first(), error().sum(), room);
  }

  GuardPolynomials polynomials;
};

}  // namespace

TEST_CASE("the points begin and end with the interval, and are denser at its ends",
          "[guard_polynomials]") {
  const One one([](double u) { return u; }, 2.0, 5.0);
  CHECK(one.polynomials.point(0) == 2.0);
  CHECK(one.polynomials.point(GuardPolynomials::degree) == 5.0);
  for (int j = 0; j <= GuardPolynomials::degree; ++j) {
    const double cosine = std::cos(std::numbers::pi * j / GuardPolynomials::degree);
    CHECK_THAT(one.polynomials.point(j), WithinAbs(3.5 - 1.5 * cosine, 8.0 * eps));
  }
}

TEST_CASE("a polynomial of its degree is the guard, but for the rounding of the formula",
          "[guard_polynomials]") {
  const double size = GENERATE(1e-200, 1.0, 1e200);
  const One one([=](double u) { return size * std::pow(u - 0.3, 9.0); });
  const double largest = size * std::pow(0.7, 9.0);
  CHECK(one.error().rounding >= 2.0 * eps * largest);    // thirteen terms, each rounded
  CHECK(one.error().rounding <= 100.0 * eps * largest);  // a crossing is known to so much
  CHECK_FALSE(one.error().is_truncated());
}

TEST_CASE("the error of a guard that is no polynomial bounds the terms that are left out",
          "[guard_polynomials]") {
  // The coefficients fall by the ellipse through the poles at 1/2 +- i / sharp (Trefethen, ch. 8).
  for (const double sharp : {5.0, 3.0}) {
    const Function g = [=](double u) {
      return 1.0 / (1.0 + sharp * sharp * (u - 0.5) * (u - 0.5)) - 0.7;
    };
    const One one(g);
    const auto root = one.crossing(1.0);
    REQUIRE(root);
    const double exact = 0.5 - std::sqrt(1.0 / 0.7 - 1.0) / sharp;
    const double slope = std::abs(g(exact + 1e-6) - g(exact - 1e-6)) / 2e-6;
    const double worst = std::abs(*root - exact) * slope;
    INFO("sharpness " << sharp << ": off by " << worst);
    CHECK(worst <= 2.0 * one.error().sum());
    CHECK(one.error().truncation <= 100.0 * worst);
    CHECK(one.error().is_truncated());
  }
}

TEST_CASE("an error of some roundings more is no reason for a shorter interval",
          "[guard_polynomials]") {
  using Error = GuardPolynomials::Error;
  CHECK_FALSE(Error{.truncation = 5.0, .rounding = 1.0}.is_truncated());
  CHECK(Error{.truncation = 1e3, .rounding = 1.0}.is_truncated());
  CHECK(Error{.truncation = 3.0, .rounding = 2.0}.sum() == 5.0);
}

TEST_CASE("a crossing is after that of the guard, by no more than its error over its slope",
          "[guard_polynomials]") {
  struct Guarded {
    Function g;
    double root;
  };
  const auto [g, root] = GENERATE(values<Guarded>({
      {[](double u) { return u - 0.3; }, 0.3},
      {[](double u) { return 0.3 - u; }, 0.3},
      {[](double u) { return std::exp(u) - 1.5; }, std::log(1.5)},
      {[](double u) { return std::sin(u) - 0.5; }, std::numbers::pi / 6.0},
      {[](double u) { return 1e200 * (u - 0.999); }, 0.999},
  }));
  const auto found = One(g).crossing(1e-11);
  REQUIRE(found);
  CHECK(*found >= root - eps);
  CHECK(*found <= root + 1e-11);
}

TEST_CASE("a crossing that is not known well enough is none", "[guard_polynomials]") {
  // u^3 crosses at 1/2 with the slope 0 on both sides: its time is known to the third root of eps.
  const One flat([](double u) { return std::pow(u - 0.5, 3.0); });
  CHECK_FALSE(flat.polynomials.crossing(0, flat.first(), flat.error().sum(), 1e-9));
  CHECK_FALSE(One([](double u) { return std::tanh(30.0 * (u - 0.4)); }).crossing(1e-9));
}

TEST_CASE("the slope at a root is that of the guard there", "[guard_polynomials]") {
  // The crossing is shifted by error / slope; a large error shows the slope. The bend of
  // 100 (u - r)^2 is the slope within 0.01 of the root.
  const double r = 0.37;
  const One bent([=](double u) { return (u - r) * (1.0 + 100.0 * (u - r)) + 0.0; }, r - 0.004,
                 r + 1.0);
  const auto found = bent.polynomials.crossing(0, bent.first(), 1e-7, 1.0);
  REQUIRE(found);
  CHECK_THAT(*found - r, WithinRel(1e-7, 0.05));
  // A guard that rises to 1 knows a slope of 1e-10 to 1e-16 over the length of the difference.
  const One slow([=](double u) { return 1e-10 * (u - r) + std::pow(u - r, 9.0); }, r - 0.01,
                 r + 1.0);
  const auto late = slow.polynomials.crossing(0, slow.first(), 1e-13, 1.0);
  REQUIRE(late);
  CHECK_THAT(*late - r, WithinRel(1e-3, 0.02));
}

TEST_CASE("a guard that may touch zero between two points is seen", "[guard_polynomials]") {
  const int over = GuardPolynomials::degree + 1;  // it has crossed at none of the points
  const auto valley = [](double depth) {
    return One([=](double u) { return 30.0 * (u - 0.45) * (u - 0.45) - depth; });
  };
  CHECK(valley(1e-6).polynomials.may_dip(0, 1.0, over));
  CHECK_FALSE(valley(-10.0).polynomials.may_dip(0, 1.0, over));
  CHECK_FALSE(One([](double u) { return 1.0 + u; }).polynomials.may_dip(0, 1.0, over));
}
