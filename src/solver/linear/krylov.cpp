// An incomplete factorisation for GMRES.
#include "krylov.hpp"

#include "factorisation.hpp"

#include "saltus/solver/detail/linear_thresholds.hpp"

namespace saltus {

Preconditioner::Preconditioner(const Sparsity& places)
    : n_(places.columns()),
      jacobian_(Eigen::VectorXd::Zero(places.size())),
      diagonal_(sparse_layout(places).diagonal),
      matrix_(sparse_matrix(places)),
      lu_() {
  lu_.setDroptol(thresholds::dropped);
  lu_.analyzePattern(matrix_);
}

bool Preconditioner::factor(double gamma) {
  VectorRef values(matrix_.valuePtr(), matrix_.nonZeros());
  values = -gamma * jacobian_;
  for (const Index k : diagonal_) values[k] += 1.0;
  lu_.factorize(matrix_);
  return lu_.info() == Eigen::Success;
}

void Preconditioner::solve(const double* r, double* z) {
  VectorRef(z, n_) = lu_.solve(VectorView(r, n_));
}

}  // namespace saltus
