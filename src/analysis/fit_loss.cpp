// The losses of a fit, and the covariance of its parameters.
#include "fit_loss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<std::pair<std::string_view, Loss>, 5> loss_names{{{"linear", Loss::linear},
                                                                       {"soft_l1", Loss::soft_l1},
                                                                       {"huber", Loss::huber},
                                                                       {"cauchy", Loss::cauchy},
                                                                       {"arctan", Loss::arctan}}};

/// The covariance within the directions that the data determine.
struct Within {
  MatrixXd covariance;
  bool saddle = false;
};

Within within_known(const VectorXd& residuals, const MatrixXd& jacobian,
                    const UncertaintyOptions& options, Index freedom) {
  const Index rank = jacobian.cols();
  if (rank == 0) return {MatrixXd(0, 0)};
  const double dof = static_cast<double>(std::max(freedom, Index{1}));
  if (options.loss == Loss::linear) {
    const double scale = options.absolute ? 1.0 : residuals.squaredNorm() / dof;
    const Eigen::JacobiSVD<MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const VectorXd inverse = svd.singularValues().cwiseAbs2().cwiseInverse();
    return {scale * (svd.matrixV() * inverse.asDiagonal() * svd.matrixV().transpose())};
  }
  VectorXd curved(residuals.size()), spread(residuals.size());
  for (Index i = 0; i < residuals.size(); ++i) {
    const double z = residuals[i] * residuals[i] / (options.f_scale * options.f_scale);
    const LossValue rho = loss_at(options.loss, z);
    curved[i] = rho.first + 2.0 * z * rho.second;
    spread[i] = rho.first * rho.first * residuals[i] * residuals[i];
  }
  const MatrixXd hessian = jacobian.transpose() * curved.asDiagonal() * jacobian;
  // The signs of D are those of the eigenvalues (Sylvester's law of inertia).
  if (hessian.ldlt().vectorD().minCoeff() <= 0.0) return {MatrixXd::Zero(rank, rank), true};
  const MatrixXd inverse = hessian.inverse();
  const MatrixXd middle = jacobian.transpose() * spread.asDiagonal() * jacobian;
  return {inverse * middle * inverse * (static_cast<double>(residuals.size()) / dof)};
}

/// The parameters that an undetermined direction moves, beyond its own rounding.
std::vector<Index> taking_part(const VectorXd& direction) {
  std::vector<Index> all;
  for (Index k = 0; k < direction.size(); ++k)
    if (std::abs(direction[k]) > open_part) all.push_back(k);
  return all;
}

void forget(MatrixXd& covariance, Index k) {
  covariance.row(k).setConstant(std::numeric_limits<double>::quiet_NaN());
  covariance.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::string_view to_string(Loss loss) { return nth(loss_names, loss).first; }

Loss loss_from(std::string_view name) { return detail::value_of(loss_names, "loss", name); }

LossValue loss_at(Loss loss, double z) {
  switch (loss) {
    case Loss::soft_l1: {
      const double root = std::sqrt(1.0 + z);
      return {2.0 * (root - 1.0), 1.0 / root, -0.5 / (root * root * root)};
    }
    case Loss::huber: {
      if (z <= 1.0) return {z, 1.0, 0.0};
      const double root = std::sqrt(z);
      return {2.0 * root - 1.0, 1.0 / root, -0.5 / (root * z)};
    }
    case Loss::cauchy:
      return {std::log1p(z), 1.0 / (1.0 + z), -1.0 / ((1.0 + z) * (1.0 + z))};
    case Loss::arctan: {
      const double t = 1.0 + z * z;
      return {std::atan(z), 1.0 / t, -2.0 * z / (t * t)};
    }
    case Loss::linear:
      break;
  }
  return {z, 1.0, 0.0};
}

double cost_of(const VectorXd& residuals, Loss loss, double f_scale) {
  if (loss == Loss::linear) return 0.5 * residuals.squaredNorm();
  double sum = 0.0;
  for (const double r : residuals) sum += loss_at(loss, r * r / (f_scale * f_scale)).value;
  return 0.5 * f_scale * f_scale * sum;
}

void weigh(VectorXd& residuals, MatrixXd& jacobian, Loss loss, double f_scale) {
  if (loss == Loss::linear) return;
  for (Index i = 0; i < residuals.size(); ++i) {
    const double z = residuals[i] * residuals[i] / (f_scale * f_scale);
    const LossValue rho = loss_at(loss, z);
    const double curved = std::max(rho.first + 2.0 * z * rho.second, least_curved * rho.first);
    residuals[i] *= rho.first / std::sqrt(curved);
    jacobian.row(i) *= std::sqrt(curved);
  }
}

Uncertainty uncertainty_of(const VectorXd& residuals, const MatrixXd& jacobian,
                           const UncertaintyOptions& options) {
  const Index n = jacobian.rows(), p = jacobian.cols();
  VectorXd length = jacobian.colwise().norm();
  length = (length.array() > 0.0).select(length, 1.0);
  const MatrixXd scaled = jacobian * length.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeFullV);
  const double least = std::max(options.rtol, static_cast<double>(std::max(n, p)) * unit_rounding);
  const Index rank = (svd.singularValues().array() > least * svd.singularValues()[0]).count();
  const MatrixXd known = svd.matrixV().leftCols(rank);
  const Within within = within_known(residuals, scaled * known, options, n - p);
  Uncertainty found;
  found.saddle = within.saddle;
  const VectorXd unit = length.cwiseInverse();
  found.covariance =
      unit.asDiagonal() * (known * within.covariance * known.transpose()) * unit.asDiagonal();
  std::set<Index> involved;
  for (Index k = rank; k < p; ++k) {
    found.undetermined.push_back(taking_part(svd.matrixV().col(k)));
    involved.insert(found.undetermined.back().begin(), found.undetermined.back().end());
  }
  if (found.saddle || (n == p && !options.absolute))
    for (Index k = 0; k < p; ++k) involved.insert(k);
  for (const Index k : involved) forget(found.covariance, k);
  for (const Index k : involved) found.covariance(k, k) = std::numeric_limits<double>::infinity();
  return found;
}

}  // namespace saltus
