// Averages over the pieces of a run: exponents and standard errors.
#pragma once

#include <Eigen/Core>

namespace saltus {

/// (pieces, directions) [1/s] The mean growth rates from the first piece to each one.
Eigen::MatrixXd running_means(const Eigen::VectorXd& durations, const Eigen::MatrixXd& logs);

/// (directions,) [1/s] The standard errors of the means, by batches: the time is divided into B parts,
/// and the variance of the mean is that of the B means divided by B - 1 (G. Fishman, Monte Carlo,
/// Springer 1996, section 6.3). 0 for a direction of which nothing is left, infinite with too few
/// pieces.
Eigen::VectorXd standard_errors(const Eigen::VectorXd& durations, const Eigen::MatrixXd& logs);

}  // namespace saltus
