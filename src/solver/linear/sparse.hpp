// A pattern as a sparse matrix of Eigen.
#pragma once

#include <algorithm>

#include <Eigen/SparseCore>

#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

template <class T>
using SparseColumnsOf = Eigen::SparseMatrix<T, Eigen::ColMajor, int>;
using SparseColumns = SparseColumnsOf<double>;

/// The matrix with a one at each of these places. Its values are in the order of the pattern.
template <class T = double>
SparseColumnsOf<T> sparse_matrix(const Sparsity& places) {
  const auto n = places.columns();
  SparseColumnsOf<T> matrix(n, n);
  matrix.resizeNonZeros(places.size());
  std::ranges::transform(places.start, matrix.outerIndexPtr(),
                         [](Index k) { return static_cast<int>(k); });
  std::ranges::copy(places.rows, matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), places.size(), T(1.0));
  return matrix;
}

}  // namespace saltus
