// The linear systems of simplified Newton, (I - h A x J) x = r: the eigenvalues of A make s systems
// of n unknowns out of one of s n, a complex pair as one (E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II, section IV.8). J is sparse and comes from differences.
#pragma once

#include <complex>
#include <memory>

#include "problem.hpp"

/// Jacobians by differences of 17 digits, columns without a common row at once.
class Differences {
 public:
  explicit Differences(const Problem& problem);
  Sparse operator()(Quad t, const Vector& y) const;

 private:
  void find_rows();
  void find_groups();

  const Problem& problem_;
  std::vector<std::vector<Eigen::Index>> rows_;    // of each column
  std::vector<std::vector<Eigen::Index>> groups_;  // of columns
};

class Newton {
 public:
  explicit Newton(const Tableau& tableau);
  void factorise(Quad h, const Sparse& jacobian);
  /// One column a stage, in and out.
  Matrix solve(const Matrix& residual) const;

 private:
  using Complex = std::complex<long double>;
  using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;
  using ComplexSparse = Eigen::SparseMatrix<Complex>;

  Eigen::Matrix<Complex, Eigen::Dynamic, 1> values_;
  ComplexMatrix vectors_, inverse_;
  std::vector<Eigen::Index> kept_;  // eigenvalues that are real or above the real axis
  std::vector<std::unique_ptr<Eigen::SparseLU<ComplexSparse>>> lu_;
};
