// Eigenvalues, for all layers: Eigen's template is compiled in one place, as it takes 8 s.
#pragma once

#include <Eigen/Core>

namespace saltus::detail {

/// The eigenvalues of a square matrix, in the order of Eigen::EigenSolver (Hessenberg form, then QR
/// steps: Golub & Van Loan, Matrix Computations, 7.4 and 7.5).
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace saltus::detail
