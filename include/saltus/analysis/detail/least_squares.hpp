// Least squares within bounds, by the method of Levenberg and Marquardt.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

namespace saltus::detail {

/// Residuals r(x) to be made small, with their Jacobian dr/dx.
struct LeastSquares {
  /// The cost at x, which is |r|^2 / 2 unless a loss weighs the residuals; empty where x cannot be
  /// evaluated: then the step is shortened.
  std::function<std::optional<double>(const Eigen::VectorXd& x)> cost;
  /// r and dr/dx at an x that has a cost; with a loss those of the quadratic model of the cost.
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residual,
                     Eigen::MatrixXd& jacobian)>
      linear;
};

/// When a search ends. All are relative numbers without a unit.
struct LeastSquaresLimits {
  double cost = 1e-8;       ///< of the cost, that a step takes away
  double step = 1e-8;       ///< of the scaled length of x, that a step has
  double gradient = 1e-15;  ///< the largest cosine between r and a column of the Jacobian
  int evaluations = 100;    ///< of the cost, at most
};

enum class LeastSquaresEnd { gradient, cost, step, evaluations };

struct LeastSquaresFound {
  Eigen::VectorXd x;
  double cost = 0.0;
  LeastSquaresEnd end = LeastSquaresEnd::step;
  int evaluations = 0;
};

/// The x within the bounds with the least cost that a descent from `start`, which has to have a cost,
/// comes to. A step minimises |r + J s|^2 + lambda |D s|^2 (D. Marquardt, SIAM J. Appl. Math. 11
/// (1963) 431), with the column lengths D of J, so that the units of x do not matter (J. More, in
/// Lecture Notes in Mathematics 630 (1978) 105), and lambda by the ratio of the reductions that are
/// found and predicted (H. Nielsen, report IMM-REP-1999-05, Technical University of Denmark).
///
/// A value at a bound stays there while the gradient points outwards. A value that a step would take
/// beyond a bound is put on the bound, and the others are solved for again. This is the projection of
/// D. Bertsekas, SIAM J. Control Optim. 20 (1982) 221. Eigen's own LevenbergMarquardt has no bounds,
/// and ends where an evaluation fails.
LeastSquaresFound least_squares(const LeastSquares& problem, const Eigen::VectorXd& start,
                                const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                const LeastSquaresLimits& limits);

}  // namespace saltus::detail
