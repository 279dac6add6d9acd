// The preconditioner of GMRES: an incomplete factorisation of I - gamma J.
#pragma once

#include <Eigen/IterativeLinearSolvers>

#include "saltus/solver/detail/jacobian.hpp"
#include "sparse.hpp"

namespace saltus {

/// Drops small entries and keeps the largest entries of each row (Y. Saad, "ILUT: a dual threshold
/// incomplete LU factorization", Numer. Linear Algebra Appl. 1 (1994) 387).
class Preconditioner {
 public:
  explicit Preconditioner(const Sparsity& places);

  double* jacobian() { return jacobian_.data(); }
  /// Factorises. False if a pivot is zero.
  bool factor(double gamma);
  void solve(const double* r, double* z);

 private:
  Index n_;
  Eigen::VectorXd jacobian_;
  std::vector<Index> diagonal_;
  SparseColumns matrix_;
  Eigen::IncompleteLUT<double, int> lu_;
};

}  // namespace saltus
