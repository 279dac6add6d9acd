// Factorisation and solution of the systems of a step.
#include "stage_systems.hpp"

#include <algorithm>

namespace saltus::radau {

template <class T>
bool StageSystems::System<T>::factor(const LinearStructure& structure,
                                     const std::vector<double>& jacobian, double h, T eigenvalue) {
  if (!solver) solver = structure.make_factorisation<T>();
  matrix.resize(jacobian.size());
  std::ranges::transform(jacobian, matrix.begin(), [h](double value) { return T(-h * value); });
  for (const Index place : structure.layout().diagonal)
    matrix[static_cast<std::size_t>(place)] += eigenvalue;
  return solver->factor(matrix.data());
}

bool StageSystems::factor(const std::vector<double>& jacobian, const Scheme& scheme, double h) {
  stages_ = 0;
  if (!real_.factor(*structure_, jacobian, h, scheme.gamma)) return false;
  for (int k = 0; k < scheme.pairs(); ++k) {
    const Complex eigenvalue(scheme.alpha[k], scheme.beta[k]);
    if (!pairs_[static_cast<std::size_t>(k)].factor(*structure_, jacobian, h, eigenvalue))
      return false;
  }
  right_.resize(structure_->layout().diagonal.size());
  stages_ = scheme.stages, h_ = h;
  return true;
}

void StageSystems::solve_pair(int k, double* re, double* im) {
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = {re[i], im[i]};
  pairs_[static_cast<std::size_t>(k)].solver->solve(right_.data());
  for (std::size_t i = 0; i < right_.size(); ++i)
    re[i] = right_[i].real(), im[i] = right_[i].imag();
}

}  // namespace saltus::radau
