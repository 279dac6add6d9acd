// The dense solvers by size: unrolled for few states, Eigen's blocks for many.
#include <Eigen/LU>

#include "elimination.hpp"

#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

namespace {

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
  if (small <= thresholds::unrolled_dense) return make_unrolled(small);
  if (n < thresholds::large_dense) return std::make_unique<Elimination<0>>(small);
  return std::make_unique<LargeDense>(n);
}

}  // namespace saltus
