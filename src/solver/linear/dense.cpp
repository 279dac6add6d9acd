// Gaussian elimination with partial pivoting; written out for few states, Eigen's blocks for many.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/LU>

#include "factorisation.hpp"

namespace saltus {

namespace {

/// In place, column by column (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., algorithm
/// 3.4.1). The diagonal keeps the reciprocals of the pivots.
class SmallDense final : public Factorisation {
 public:
  explicit SmallDense(Index n) : n_(n), pivots_(static_cast<std::size_t>(n)) {}

  bool factor(double* a) override {
    a_ = a;
    for (Index k = 0; k < n_; ++k) {
      double* column = a + k * n_;
      Index best = k;
      for (Index i = k + 1; i < n_; ++i)
        if (std::abs(column[i]) > std::abs(column[best])) best = i;
      pivots_[static_cast<std::size_t>(k)] = best;
      if (!(std::abs(column[best]) > 0.0)) return false;
      if (best != k)
        for (Index j = 0; j < n_; ++j) std::swap(a[k + j * n_], a[best + j * n_]);
      column[k] = 1.0 / column[k];
      for (Index i = k + 1; i < n_; ++i) column[i] *= column[k];
      for (Index j = k + 1; j < n_; ++j) subtract(column, a[k + j * n_], k + 1, a + j * n_);
    }
    return true;
  }

  void solve(double* b) override {
    for (Index k = 0; k < n_; ++k) {
      const Index pivot = pivots_[static_cast<std::size_t>(k)];
      if (pivot != k) std::swap(b[k], b[pivot]);
    }
    for (Index k = 0; k < n_; ++k) subtract(a_ + k * n_, b[k], k + 1, b);
    for (Index k = n_ - 1; k >= 0; --k) {
      const double* column = a_ + k * n_;
      b[k] *= column[k];
      for (Index i = 0; i < k; ++i) b[i] -= column[i] * b[k];
    }
  }

 private:
  /// y -= factor x from entry `first` on.
  void subtract(const double* x, double factor, Index first, double* y) const {
    if (factor == 0.0) return;
    for (Index i = first; i < n_; ++i) y[i] -= factor * x[i];
  }

  Index n_;
  double* a_ = nullptr;
  std::vector<Index> pivots_;
};

class LargeDense final : public Factorisation {
 public:
  explicit LargeDense(Index n) : n_(n), lu_(n) {}

  bool factor(double* a) override {
    lu_.compute(MatrixRef(a, n_, n_));
    const auto pivots = lu_.matrixLU().diagonal().cwiseAbs();
    return pivots.allFinite() && pivots.minCoeff() > 0.0;
  }
  void solve(double* b) override {
    VectorRef x(b, n_);
    lu_.permutationP().applyThisOnTheLeft(x);
    lu_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(x);
    lu_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(x);
  }

 private:
  Index n_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

/// From here on Eigen's blocks are faster (bench/linear_solvers).
constexpr Index large = 48;

}  // namespace

MatrixLayout dense_layout(const Sparsity& places) {
  const Index n = places.columns();
  MatrixLayout layout{.size = n * n, .places = {}, .diagonal = {}};
  for (Index j = 0; j < n; ++j) {
    for (const int i : places.column(j)) layout.places.push_back(i + j * n);
    layout.diagonal.push_back(j + j * n);
  }
  return layout;
}

std::unique_ptr<Factorisation> make_dense(Index n) {
  if (n < large) return std::make_unique<SmallDense>(n);
  return std::make_unique<LargeDense>(n);
}

}  // namespace saltus
