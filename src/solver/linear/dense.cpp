// Gaussian elimination with partial pivoting; written out for few states, Eigen's blocks for many.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/LU>

#include "factorisation.hpp"

#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

namespace {

/// Factorises in place, column by column (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th
/// ed., algorithm 3.4.1). The diagonal keeps the reciprocals of the pivots. With a fixed size the
/// compiler unrolls the loops; size 0 is known at run time only.
template <int fixed>
class SmallDense final : public Factorisation {
 public:
  explicit SmallDense(int n) : n_(n), pivots_(static_cast<std::size_t>(n)) {}

  bool factor(double* a) override {
    a_ = a;
    for (int k = 0; k < n(); ++k) {
      double* column = a + k * n();
      int best = k;
      for (int i = k + 1; i < n(); ++i)
        if (std::abs(column[i]) > std::abs(column[best])) best = i;
      pivots_[static_cast<std::size_t>(k)] = best;
      if (!(std::abs(column[best]) > 0.0)) return false;
      if (best != k)
        for (int j = 0; j < n(); ++j) std::swap(a[k + j * n()], a[best + j * n()]);
      column[k] = 1.0 / column[k];
      for (int i = k + 1; i < n(); ++i) column[i] *= column[k];
      for (int j = k + 1; j < n(); ++j) {
        double* other = a + j * n();
        const double factor = other[k];
        for (int i = k + 1; i < n(); ++i) other[i] -= factor * column[i];
      }
    }
    return true;
  }

  void solve(double* b) override {
    for (int k = 0; k < n(); ++k) std::swap(b[k], b[pivots_[static_cast<std::size_t>(k)]]);
    for (int k = 0; k < n(); ++k) {
      for (int i = k + 1; i < n(); ++i) b[i] -= a_[i + k * n()] * b[k];
    }
    for (int k = n() - 1; k >= 0; --k) {
      b[k] *= a_[k + k * n()];
      for (int i = 0; i < k; ++i) b[i] -= a_[i + k * n()] * b[k];
    }
  }

 private:
  constexpr int n() const { return fixed > 0 ? fixed : n_; }

  int n_;
  double* a_ = nullptr;
  std::vector<int> pivots_;
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
  const auto small = static_cast<int>(n);
  switch (n) {
    case 1:
      return std::make_unique<SmallDense<1>>(small);
    case 2:
      return std::make_unique<SmallDense<2>>(small);
    case 3:
      return std::make_unique<SmallDense<3>>(small);
    case 4:
      return std::make_unique<SmallDense<4>>(small);
    default:
      break;
  }
  if (n < thresholds::large_dense) return std::make_unique<SmallDense<0>>(small);
  return std::make_unique<LargeDense>(n);
}

}  // namespace saltus
