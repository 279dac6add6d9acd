// The Floquet multipliers of an orbit.
#include "multipliers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/detail/eigenvalues.hpp"
#include "saltus/base/error.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool is_isolated(const MatrixXd& matrix) {
  if (matrix.size() == 0) return true;
  const MatrixXd less = matrix - MatrixXd::Identity(matrix.rows(), matrix.cols());
  const double least = less.jacobiSvd().singularValues().minCoeff();
  return least > multiplier_one * std::max(1.0, matrix.jacobiSvd().singularValues()[0]);
}

/// The factor of M f along f, and the relative error of M f = f.
std::pair<double, double> trivial_of(const MatrixXd& matrix, const VectorXd& start,
                                     const VectorXd& end) {
  const double square = end.squaredNorm();
  if (square == 0.0)
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  const VectorXd image = matrix * start;
  return {end.dot(image) / square, (image - end).norm() / std::sqrt(square)};
}

/// The matrix on the directions across the flow.
MatrixXd across_flow(const MatrixXd& matrix, const VectorXd& flow) {
  const Eigen::HouseholderQR<MatrixXd> qr(flow);
  const MatrixXd basis = qr.householderQ() * MatrixXd::Identity(flow.size(), flow.size());
  const MatrixXd across = basis.rightCols(flow.size() - 1);
  return across.transpose() * matrix * across;
}

}  // namespace

Eigen::VectorXcd largest_first(const MatrixXd& matrix) {
  if (matrix.size() == 0) return {};
  Eigen::VectorXcd values = detail::eigenvalues(matrix);
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return values;
}

Multipliers multipliers_of(const Closing& closing, const Arc& arc) {
  Multipliers found;
  found.trivial = std::numeric_limits<double>::quiet_NaN();
  MatrixXd matrix = closing.square(arc.monodromy);
  if (closing.autonomous()) {
    const VectorXd start = arc.flow_start(closing.active()), end = arc.flow_end(closing.active());
    const auto [trivial, off] = trivial_of(matrix, start, end);
    found.trivial = trivial;
    if (!(off <= trivial_off))
      found.notes.push_back(text("the flow returns with an error of ", off,
                                 " (the trivial multiplier is ", trivial,
                                 ", exactly 1): tighten rtol, or look for a part that the "
                                 "derivatives do not see"));
    matrix = across_flow(matrix, end);
  }
  found.values = largest_first(matrix);
  found.isolated = is_isolated(matrix);
  if (!found.isolated)
    found.notes.emplace_back(
        "a multiplier is 1: the orbit is one of many, as where a quantity is conserved");
  return found;
}

}  // namespace saltus
