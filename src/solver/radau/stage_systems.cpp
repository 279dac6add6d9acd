// Factorisation and solution of the systems of a step.
#include "stage_systems.hpp"

#include <algorithm>

namespace saltus::radau {

template <class T>
bool StageSystems::System<T>::factor(const LinearStructure& structure,
                                     const std::vector<double>& jacobian, T shift) {
  if (!solver) solver = structure.make_factorisation<T>();
  matrix.resize(jacobian.size());
  std::ranges::transform(jacobian, matrix.begin(), [](double value) { return T(-value); });
  for (const Index place : structure.layout().diagonal)
    matrix[static_cast<std::size_t>(place)] += shift;
  return solver->factor(matrix.data());
}

bool StageSystems::factor(const std::vector<double>& jacobian, const Scheme& scheme, double h) {
  stages_ = 0;
  if (!real_.factor(*structure_, jacobian, scheme.gamma / h)) return false;
  for (int k = 0; k < scheme.pairs(); ++k) {
    const Complex shift(scheme.alpha[k] / h, scheme.beta[k] / h);
    if (!pairs_[static_cast<std::size_t>(k)].factor(*structure_, jacobian, shift)) return false;
  }
  right_.resize(structure_->layout().diagonal.size());
  stages_ = scheme.stages, h_ = h;
  return true;
}

void StageSystems::solve_pair(int k, double* re, double* im) {
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = {re[i], im[i]};
  pairs_[static_cast<std::size_t>(k)].solver->solve(right_.data());
  for (std::size_t i = 0; i < right_.size(); ++i) re[i] = right_[i].real(), im[i] = right_[i].imag();
}

}  // namespace saltus::radau
