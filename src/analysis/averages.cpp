// Averages over the pieces of a run.
#include "averages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/analysis/detail/thresholds.hpp"

namespace saltus {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Logarithms without those of directions that are lost.
MatrixXd kept_logs(const MatrixXd& logs) {
  MatrixXd kept = logs;
  for (Index k = 0; k < logs.cols(); ++k)
    if ((logs.col(k).array() == -unbounded).any()) kept.col(k).setZero();
  return kept;
}

VectorXd errors_by_batches(const VectorXd& durations, const MatrixXd& logs, int count) {
  VectorXd times = VectorXd::Zero(count);
  MatrixXd sums = MatrixXd::Zero(count, logs.cols());
  const double whole = durations.sum();
  double end = 0.0;
  for (Index i = 0; i < durations.size(); ++i) {
    end += durations[i];
    const double middle = end - 0.5 * durations[i];
    const Index batch = std::min(static_cast<Index>(count * middle / whole), Index{count - 1});
    times[batch] += durations[i], sums.row(batch) += logs.row(i);
  }
  if ((times.array() == 0.0).any()) return VectorXd::Constant(logs.cols(), unbounded);
  VectorXd variance(logs.cols());
  for (Index k = 0; k < logs.cols(); ++k) {
    const VectorXd off = sums.col(k).cwiseQuotient(times).array() - logs.col(k).sum() / whole;
    variance[k] = off.cwiseAbs2().dot(times) / whole / (count - 1);
  }
  return variance.cwiseSqrt();
}

}  // namespace

MatrixXd running_means(const VectorXd& durations, const MatrixXd& logs) {
  MatrixXd means = logs;
  double time = 0.0;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(logs.cols());
  for (Index i = 0; i < logs.rows(); ++i) {
    time += durations[i], sum += logs.row(i);
    means.row(i) = sum / time;
  }
  return means;
}

VectorXd standard_errors(const VectorXd& durations, const MatrixXd& logs) {
  const MatrixXd kept = kept_logs(logs);
  VectorXd errors = VectorXd::Zero(logs.cols());
  for (const int count : batch_counts)
    errors = errors.cwiseMax(errors_by_batches(durations, kept, count));
  return errors;
}

}  // namespace saltus
