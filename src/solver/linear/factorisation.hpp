// Direct solvers of A x = b: what SUNDIALS's interface needs of them.
#pragma once

#include <memory>
#include <vector>

#include "saltus/solver/detail/ordering.hpp"

namespace saltus {

/// A matrix is one array of numbers; where its entries stand is said by the layout it was made
/// with.
class Factorisation {
 public:
  virtual ~Factorisation() = default;
  /// May use `a` as its memory: it is left alone until the last `solve`. False if A is singular.
  virtual bool factor(double* a) = 0;
  /// b becomes the solution.
  virtual void solve(double* b) = 0;
};

/// Where the entries of a pattern stand in the array of a matrix.
struct MatrixLayout {
  Index size = 0;               // of the array
  std::vector<Index> places;    // of each entry of the pattern
  std::vector<Index> diagonal;  // of entry (i, i)
};

/// All n by n numbers, column by column.
MatrixLayout dense_layout(const Sparsity& places);
std::unique_ptr<Factorisation> make_dense(Index n);

/// The band with state i at position[i], as LAPACK keeps it, with room for the rows that pivoting
/// brings in.
MatrixLayout band_layout(const Sparsity& places, Bandwidth band, const std::vector<int>& position);
std::unique_ptr<Factorisation> make_band(Index n, Bandwidth band, std::vector<int> position);

/// The entries of the pattern, in its order.
MatrixLayout sparse_layout(const Sparsity& places);
std::unique_ptr<Factorisation> make_sparse(const Sparsity& places);

}  // namespace saltus
