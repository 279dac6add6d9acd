// The dense solvers by size: unrolled for few states, Eigen's blocks for many.
#include <Eigen/LU>

#include "elimination.hpp"

#include "saltus/solver/detail/linear_thresholds.hpp"

namespace saltus {

namespace {

template <class T>
class LargeDense final : public FactorisationOf<T> {
 public:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

  explicit LargeDense(Index n) : n_(n), lu_(n) {}

  bool factor(T* a) override {
    lu_.compute(Eigen::Map<Matrix>(a, n_, n_));
    const auto pivots = lu_.matrixLU().diagonal().cwiseAbs();
    return pivots.allFinite() && pivots.minCoeff() > 0.0;
  }
  void solve(T* b) override {
    Eigen::Map<Vector> x(b, n_);
    lu_.permutationP().applyThisOnTheLeft(x);
    lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(x);
    lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(x);
  }

 private:
  Index n_;
  Eigen::PartialPivLU<Matrix> lu_;
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

template <class T>
std::unique_ptr<FactorisationOf<T>> make_dense(Index n) {
  const auto small = static_cast<int>(n);
  if (small <= thresholds::unrolled_dense) return make_unrolled<T>(small);
  if (n < thresholds::large_dense) return std::make_unique<Elimination<0, T>>(small);
  return std::make_unique<LargeDense<T>>(n);
}
template std::unique_ptr<FactorisationOf<double>> make_dense(Index);
template std::unique_ptr<FactorisationOf<Complex>> make_dense(Index);

}  // namespace saltus
