// The eigenvalues of a matrix, by Eigen.
#include "saltus/base/detail/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace saltus::detail {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) { return matrix.eigenvalues(); }

}  // namespace saltus::detail
