// Eigen's supernodal sparse LU.
#include "sparse.hpp"

#include <Eigen/SparseLU>

#include "factorisation.hpp"
#include "scalar.hpp"

namespace saltus {

namespace {

/// The places are analysed once, with the columns in COLAMD's order. Each factorisation chooses its
/// own pivots. (J. W. Demmel et al., "A supernodal approach to sparse partial pivoting", SIAM J.
/// Matrix Anal. Appl. 20 (1999) 720; T. A. Davis et al., "Algorithm 836: COLAMD", ACM TOMS 30
/// (2004) 377.)
template <class T>
class Sparse final : public FactorisationOf<T> {
 public:
  explicit Sparse(const Sparsity& places)
      : matrix_(sparse_matrix<T>(places)), solution_(matrix_.rows()) {
    lu_.analyzePattern(matrix_);
  }

  bool factor(T* a) override {
    std::copy_n(a, matrix_.nonZeros(), matrix_.valuePtr());
    lu_.factorize(matrix_);
    return lu_.info() == Eigen::Success;
  }
  void solve(T* b) override {
    Eigen::Map<Vector> x(b, solution_.size());
    solution_ = lu_.solve(x);
    x = solution_;
  }

 private:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  SparseColumnsOf<T> matrix_;
  Vector solution_;
  Eigen::SparseLU<SparseColumnsOf<T>, Eigen::COLAMDOrdering<int>> lu_;
};

}  // namespace

MatrixLayout sparse_layout(const Sparsity& places) {
  MatrixLayout layout{.size = places.size(), .places = {}, .diagonal = {}};
  for (Index j = 0; j < places.columns(); ++j) {
    const auto rows = places.column(j);
    const auto found = std::ranges::lower_bound(rows, static_cast<int>(j));
    layout.diagonal.push_back(places.start[j] + (found - rows.begin()));
  }
  return layout;
}

template <class T>
std::unique_ptr<FactorisationOf<T>> make_sparse(const Sparsity& places) {
  return std::make_unique<Sparse<T>>(places);
}
template std::unique_ptr<FactorisationOf<double>> make_sparse(const Sparsity&);
template std::unique_ptr<FactorisationOf<Complex>> make_sparse(const Sparsity&);

}  // namespace saltus
