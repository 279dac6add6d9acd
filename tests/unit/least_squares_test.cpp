// Least squares within bounds: problems with known minima, bounds, and places without a cost.
#include "saltus/analysis/detail/least_squares.hpp"

#include <cmath>

#include "support/leaves.hpp"

using Catch::Matchers::WithinAbs;
using support::infinite;
using support::vec;

namespace least_squares_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using saltus::detail::LeastSquares;
using saltus::detail::LeastSquaresEnd;
using saltus::detail::LeastSquaresFound;
using saltus::detail::LeastSquaresLimits;

constexpr LeastSquaresLimits tight{
    .cost = 1e-15, .step = 1e-15, .gradient = 1e-15, .evaluations = 500};

template <class Residual, class Jacobian>
LeastSquares problem(Residual residual, Jacobian jacobian) {
  LeastSquares squares;
  squares.cost = [residual](const VectorXd& x) -> std::optional<double> {
    const double cost = 0.5 * VectorXd(residual(x)).squaredNorm();
    return std::isfinite(cost) ? std::optional(cost) : std::nullopt;
  };
  squares.linear = [residual, jacobian](const VectorXd& x, VectorXd& r, MatrixXd& j) {
    r = residual(x), j = jacobian(x);
  };
  return squares;
}

/// Rosenbrock's valley: r = (10 (y - x^2), 1 - x).
LeastSquares valley() {
  return problem([](const VectorXd& v) { return vec({10.0 * (v[1] - v[0] * v[0]), 1.0 - v[0]}); },
                 [](const VectorXd& v) { return MatrixXd{{-20.0 * v[0], 10.0}, {-1.0, 0.0}}; });
}

TEST_CASE("least squares follow a curved valley to its end", "[least_squares]") {
  const LeastSquaresFound found = least_squares(
      valley(), vec({-1.2, 1.0}), vec({-infinite, -infinite}), vec({infinite, infinite}), tight);
  CHECK_THAT(found.x[0], WithinAbs(1.0, 1e-12));  // a few roundings times the condition, 2500
  CHECK_THAT(found.x[1], WithinAbs(1.0, 1e-12));
  CHECK(found.evaluations < 60);
}

TEST_CASE("least squares end on the bound in the way, at the least cost there", "[least_squares]") {
  // with x <= 0.5 the least is at x = 0.5, y = x^2; with y >= 1.5 where d/dx vanishes:
  // 200 x (x^2 - 1.5) = 1 - x, which has the root below
  const LeastSquaresFound left = least_squares(
      valley(), vec({-1.2, 1.0}), vec({-infinite, -infinite}), vec({0.5, infinite}), tight);
  CHECK(left.x[0] == 0.5);
  // the cost 1/8 is at its least to 1e-15 of itself: (10 dy)^2 / 2 < 2e-16
  CHECK_THAT(left.x[1], WithinAbs(0.25, 2e-9));
  CHECK_THAT(left.cost, WithinAbs(0.125, 1e-14));
  const LeastSquaresFound above = least_squares(valley(), vec({1.3, 2.0}), vec({-infinite, 1.5}),
                                                vec({infinite, infinite}), tight);
  CHECK(above.x[1] == 1.5);
  const double x = above.x[0];
  CHECK_THAT(200.0 * x * (x * x - 1.5) - (1.0 - x), WithinAbs(0.0, 1e-6));  // of terms of size 200
}

TEST_CASE("a step to where there is no cost is shortened", "[least_squares]") {
  // the first Newton step of log x = -3 from x = 3 leads to x = -9.3
  const LeastSquares squares =
      problem([](const VectorXd& v) { return vec({std::log(v[0]) + 3.0}); },
              [](const VectorXd& v) { return MatrixXd{{1.0 / v[0]}}; });
  const LeastSquaresFound found =
      least_squares(squares, vec({3.0}), vec({-infinite}), vec({infinite}), tight);
  CHECK_THAT(found.x[0], WithinAbs(std::exp(-3.0), 1e-15));
}

TEST_CASE("the unit of a value does not matter", "[least_squares]") {
  for (const double unit : {1e-9, 1.0, 1e9}) {
    const LeastSquares squares = problem(
        [unit](const VectorXd& v) {
          return vec({v[0] / unit + 1e3 * v[1] - 3.0, std::exp(v[0] / unit) - std::exp(1.0)});
        },
        [unit](const VectorXd& v) {
          return MatrixXd{{1.0 / unit, 1e3}, {std::exp(v[0] / unit) / unit, 0.0}};
        });
    const LeastSquaresFound found =
        least_squares(squares, vec({0.2 * unit, 0.0}), vec({-infinite, -infinite}),
                      vec({infinite, infinite}), tight);
    CHECK_THAT(found.x[0] / unit, WithinAbs(1.0, 1e-14));
    CHECK_THAT(found.x[1], WithinAbs(2e-3, 1e-16));
  }
}

TEST_CASE("the limit of evaluations and a flat cost end a search", "[least_squares]") {
  LeastSquaresLimits few = tight;
  few.evaluations = 3;
  const auto none = vec({-infinite, -infinite}), all = vec({infinite, infinite});
  const LeastSquaresFound stopped = least_squares(valley(), vec({-1.2, 1.0}), none, all, few);
  CHECK(stopped.end == LeastSquaresEnd::evaluations);
  CHECK(stopped.evaluations == 3);
  const LeastSquares flat = problem([](const VectorXd&) { return vec({1.0}); },
                                    [](const VectorXd&) { return MatrixXd{{0.0}}; });
  const LeastSquaresFound still =
      least_squares(flat, vec({2.0}), vec({-infinite}), vec({infinite}), tight);
  CHECK(still.end == LeastSquaresEnd::gradient);
  CHECK(still.x[0] == 2.0);
}

}  // namespace least_squares_test
