// Factorisation and solution of the systems of a step.
#include "stage_systems.hpp"

#include <algorithm>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/one_thread.hpp"
#include "saltus/solver/detail/radau/side_by_side.hpp"

namespace saltus::radau {

template <class T>
bool StageSystems::System<T>::factor(const LinearStructure& structure,
                                     const std::vector<double>& jacobian, double h, T eigenvalue) {
  if (!solver) solver = structure.make_factorisation<T>();
  matrix.resize(jacobian.size());
  std::ranges::transform(jacobian, matrix.begin(), [h](double value) { return T(-h * value); });
  for (const Index place : structure.layout().diagonal) nth(matrix, place) += eigenvalue;
  return solver->factor(matrix.data());
}

bool StageSystems::factor_real(const std::vector<double>& jacobian, const Scheme& scheme,
                               double h) {
  return real_.factor(*structure_, jacobian, h, scheme.gamma);
}

bool StageSystems::factor_pairs(int first, const std::vector<double>& jacobian,
                                const Scheme& scheme, double h) {
  for (int k = first; k < scheme.pairs(); k += 2) {
    const Complex eigenvalue(scheme.alpha[k], scheme.beta[k]);
    if (!nth(pairs_, k).factor(*structure_, jacobian, h, eigenvalue)) return false;
  }
  return true;
}

bool StageSystems::factor(const std::vector<double>& jacobian, const Scheme& scheme, double h) {
  stages_ = 0;
  right_.resize(structure_->layout().diagonal.size());
  const bool apart =
      side_by_side(structure_->choice().time, scheme.pairs(), cores_, OneThread::asked());
  bool even = false, others = false;
  call_both(
      apart, [&] { even = factor_pairs(0, jacobian, scheme, h); },
      [&] { others = factor_real(jacobian, scheme, h) && factor_pairs(1, jacobian, scheme, h); });
  if (!even || !others) return false;
  stages_ = scheme.stages, h_ = h;
  return true;
}

void StageSystems::solve_pair(int k, double* re, double* im) {
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = {re[i], im[i]};
  nth(pairs_, k).solver->solve(right_.data());
  for (std::size_t i = 0; i < right_.size(); ++i)
    re[i] = right_[i].real(), im[i] = right_[i].imag();
}

}  // namespace saltus::radau
