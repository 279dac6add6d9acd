// Direct solvers of A x = b, for real and complex matrices.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "saltus/solver/detail/ordering.hpp"

namespace saltus {

/// A direct solver for numbers of type T, double or std::complex<double>. A matrix is one array of
/// numbers; its layout has the positions of the entries.
template <class T>
class FactorisationOf {
 public:
  virtual ~FactorisationOf() = default;
  /// Factorises A. It may use `a` as its memory until the last `solve`. False if A is singular.
  virtual bool factor(T* a) = 0;
  /// b becomes the solution.
  virtual void solve(T* b) = 0;
};
using Factorisation = FactorisationOf<double>;

/// The positions of the entries of a pattern in the array of a matrix.
struct MatrixLayout {
  Index size = 0;               // of the array
  std::vector<Index> places;    // of each entry of the pattern
  std::vector<Index> diagonal;  // of entry (i, i)
};

/// The layout of all n by n numbers, column by column.
MatrixLayout dense_layout(const Sparsity& places);
template <class T>
std::unique_ptr<FactorisationOf<T>> make_dense(Index n);

/// The layout of LAPACK for a band with state i at position[i], with room for the rows that
/// pivoting adds.
MatrixLayout band_layout(const Sparsity& places, Bandwidth band, const std::vector<int>& position);
template <class T>
std::unique_ptr<FactorisationOf<T>> make_band(Index n, Bandwidth band, std::vector<int> position);

/// The layout of the entries of the pattern, in its order.
MatrixLayout sparse_layout(const Sparsity& places);
template <class T>
std::unique_ptr<FactorisationOf<T>> make_sparse(const Sparsity& places);

}  // namespace saltus
