// A pattern as a sparse matrix of Eigen.
#pragma once

#include <algorithm>

#include <Eigen/SparseCore>

#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// The matrix with a one at each of these places. Its values are in the order of the pattern.
inline SparseColumns sparse_matrix(const Sparsity& places) {
  const auto n = places.columns();
  SparseColumns matrix(n, n);
  matrix.resizeNonZeros(places.size());
  std::ranges::transform(places.start, matrix.outerIndexPtr(),
                         [](Index k) { return static_cast<int>(k); });
  std::ranges::copy(places.rows, matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), places.size(), 1.0);
  return matrix;
}

}  // namespace saltus
