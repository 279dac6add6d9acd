// Variation: S' = A(t) S + b(t) by collocation.
#include "saltus/simulation/detail/variation.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace saltus;
using Eigen::MatrixXd;

namespace {

/// s' = cos(t) s with s(0) = 1: s = exp(sin t).
void growth(double t, MatrixXd& a, MatrixXd& b) {
  a.setConstant(1, 1, std::cos(t));
  b.setZero(1, 1);
}

MatrixXd one() { return MatrixXd::Ones(1, 1); }

/// The error at t = 2 after steps of length h, with no control of the error.
double error_after_steps_of(double h) {
  Variation variation({.rtol = 1e9, .atol = one()});
  MatrixXd s = one();
  for (double t = 0.0; t < 2.0 - 0.5 * h; t += h) variation.advance(t, t + h, growth, s);
  return std::abs(s(0, 0) - std::exp(std::sin(2.0)));
}

}  // namespace

TEST_CASE("the collocation has order 9 at the ends of steps", "[variation][order]") {
  // The error term after h^9 changes the observed order by less than one at these steps.
  const double order = std::log2(error_after_steps_of(0.5) / error_after_steps_of(0.25));
  CHECK(order > 8.0);
  CHECK(order < 10.0);
}

TEST_CASE("a step is divided until the tolerance is met, inside it too", "[variation]") {
  Variation variation({.rtol = 1e-10, .atol = MatrixXd::Constant(1, 1, 1e-12)});
  MatrixXd s = one(), inside;
  variation.advance(0.0, 6.0, growth, s);
  // Ten tolerances: the errors of the pieces add up.
  CHECK(std::abs(s(0, 0) - std::exp(std::sin(6.0))) < 1e-9);
  for (const double t : {0.01, 1.0, 2.5, 5.99}) {
    REQUIRE(variation.at(t, inside));
    CHECK(std::abs(inside(0, 0) - std::exp(std::sin(t))) < 1e-8);
  }
  CHECK_FALSE(variation.at(6.5, inside));
  variation.forget();
  CHECK_FALSE(variation.at(1.0, inside));
}

TEST_CASE("a stiff equation is damped in one step", "[variation][stiff]") {
  Variation variation({.rtol = 1e9, .atol = one()});
  MatrixXd s = one();
  const auto fast = [](double, MatrixXd& a, MatrixXd& b) {
    a.setConstant(1, 1, -1e8), b.setConstant(1, 1, 3e8);
  };
  variation.advance(0.0, 1.0, fast, s);
  // L-stable: the factor of the start goes as 1 / (h lambda).
  CHECK(std::abs(s(0, 0) - 3.0) < 1e-6);
}

TEST_CASE("a column that is not a number stays one and does not hold the others up",
          "[variation]") {
  Variation variation({.rtol = 1e-10, .atol = MatrixXd::Constant(1, 2, 1e-12)});
  MatrixXd s = MatrixXd::Ones(1, 2);
  s(0, 1) = std::numeric_limits<double>::quiet_NaN();
  variation.advance(
      0.0, 2.0,
      [](double t, MatrixXd& a, MatrixXd& b) { a.setConstant(1, 1, std::cos(t)), b.setZero(1, 2); },
      s);
  CHECK(std::abs(s(0, 0) - std::exp(std::sin(2.0))) < 1e-9);
  CHECK(std::isnan(s(0, 1)));
}
