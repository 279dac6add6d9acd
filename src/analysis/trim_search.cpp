// The search for an operating point: least squares within bounds, then Newton's method.
#include "trim_search.hpp"

#include <cmath>

#include <Eigen/QR>

#include "saltus/analysis/detail/least_squares.hpp"
#include "saltus/analysis/detail/thresholds.hpp"

namespace saltus {

namespace {

TrimScales scales_of(const TrimPoint& first, const TrimBounds& bounds) {
  TrimScales scales;
  scales.sizes = first.values.cwiseAbs();
  scales.unknowns = scales.sizes;
  for (Index k = 0; k < scales.sizes.size(); ++k) {
    const double width = bounds.upper[k] - bounds.lower[k];
    if (scales.sizes[k] == 0.0) scales.unknowns[k] = std::isfinite(width) ? width : 1.0;
  }
  scales.rows = first.jacobian.cwiseAbs() * scales.unknowns;
  scales.rows = (scales.rows.array() > 0.0).select(scales.rows, 1.0);
  return scales;
}

/// Residuals and derivatives with rows and columns of size 1.
Eigen::VectorXd scaled_residual(const TrimPoint& point, const TrimScales& scales) {
  return point.residual.cwiseQuotient(scales.rows);
}
Eigen::MatrixXd scaled_jacobian(const TrimPoint& point, const TrimScales& scales) {
  return scales.rows.cwiseInverse().asDiagonal() * point.jacobian * scales.unknowns.asDiagonal();
}

/// Whether each |r| is below tolerance |J| |v|, or of the rounding of the unknowns. v are the sizes
/// of the unknowns on the way. So no residual counts as small because its unit is large. A residual
/// below the rounding of the numbers that the equation reads counts as zero.
bool is_solution(const TrimPoint& point, const TrimScales& scales, double tolerance) {
  const Eigen::MatrixXd by = point.jacobian.cwiseAbs();
  const Eigen::VectorXd allowed = (tolerance * (by * scales.sizes))
                                      .cwiseMax(unknown_noise * (by * scales.unknowns))
                                      .cwiseMax(point.rounding);
  return (point.residual.cwiseAbs().array() <= allowed.array()).all();
}

struct Fitted {
  Eigen::VectorXd values;
  bool limit = false;
};

Fitted least_squares_from(TrimProblem& problem, const TrimPoint& first, const TrimBounds& bounds,
                          const TrimScales& scales, std::optional<int> max_nfev) {
  TrimPoint last = first;
  const auto at = [&](const Eigen::VectorXd& w) {
    const Eigen::VectorXd values = bounds.clipped(w.cwiseProduct(scales.unknowns));
    if (values == last.values) return true;
    auto point = problem.tried(values);
    if (point) last = std::move(*point);
    return point.has_value();
  };
  detail::LeastSquares squares;
  squares.cost = [&](const Eigen::VectorXd& w) -> std::optional<double> {
    if (!at(w)) return {};
    return 0.5 * scaled_residual(last, scales).squaredNorm();
  };
  squares.linear = [&](const Eigen::VectorXd& w, Eigen::VectorXd& residual,
                       Eigen::MatrixXd& jacobian) {
    at(w);  // asked for at points with a cost only
    residual = scaled_residual(last, scales), jacobian = scaled_jacobian(last, scales);
  };
  const int most = max_nfev.value_or(100 * static_cast<int>(first.values.size()));
  const double tight = 10.0 * unit_rounding;
  const auto found = detail::least_squares(
      squares, first.values.cwiseQuotient(scales.unknowns),
      bounds.lower.cwiseQuotient(scales.unknowns), bounds.upper.cwiseQuotient(scales.unknowns),
      {.cost = tight, .step = tight, .gradient = tight, .evaluations = most});
  return {bounds.clipped(found.x.cwiseProduct(scales.unknowns)),
          found.end == detail::LeastSquaresEnd::evaluations};
}

/// The best of a few Newton steps: least squares end early at a small cost.
TrimPoint with_newton(TrimProblem& problem, TrimPoint point, const TrimBounds& bounds,
                      const TrimScales& scales) {
  for (int i = 0; i < last_newton_steps; ++i) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> orthogonal;
    orthogonal.setThreshold(newton_rank);
    orthogonal.compute(scaled_jacobian(point, scales));
    const Eigen::VectorXd step = orthogonal.solve(-scaled_residual(point, scales));  // the shortest
    auto better = problem.tried(bounds.clipped(point.values + step.cwiseProduct(scales.unknowns)));
    if (!better ||
        !(scaled_residual(*better, scales).norm() < scaled_residual(point, scales).norm()))
      break;
    point = std::move(*better);
    if (step.cwiseAbs().maxCoeff() <= unit_rounding) break;
  }
  return point;
}

}  // namespace

TrimFound search_point(TrimProblem& problem, const Eigen::VectorXd& start, const TrimBounds& bounds,
                       double tolerance, std::optional<int> max_nfev) {
  TrimFound found;
  found.first = problem.at(start);
  found.scales = scales_of(found.first, bounds);
  const Fitted fitted = least_squares_from(problem, found.first, bounds, found.scales, max_nfev);
  found.point = with_newton(problem, problem.at(fitted.values), bounds, found.scales);
  found.scales.sizes = found.scales.sizes.cwiseMax(found.point.values.cwiseAbs());
  if (!is_solution(found.point, found.scales, tolerance))
    found.status = fitted.limit ? SearchStatus::max_nfev : SearchStatus::stalled;
  return found;
}

}  // namespace saltus
