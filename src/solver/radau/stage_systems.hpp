// The linear systems of a step: (lambda - h J) d = r for the eigenvalues lambda of A^-1.
#pragma once

#include <array>
#include <memory>
#include <thread>
#include <vector>

#include "../linear/scalar.hpp"
#include "../linear/structure.hpp"
#include "saltus/solver/detail/radau/scheme.hpp"

namespace saltus::radau {

/// One real and up to three complex matrices with one layout, in place of one matrix for all stages
/// (Hairer, Wanner II, IV.8, (8.13)). No function allocates after the first `factor` for a number
/// of stages, except within Eigen's sparse factorisation.
class StageSystems {
 public:
  /// Solves with matrices of this structure, which has to be direct.
  explicit StageSystems(const LinearStructure& structure) : structure_(&structure) {}

  /// Factorises for a step of length h, large matrices in two threads; `jacobian` has the values of
  /// J in the layout. False if a matrix is singular.
  bool factor(const std::vector<double>& jacobian, const Scheme& scheme, double h);
  /// Whether the last factorisation was for this step.
  bool serves(const Scheme& scheme, double h) const { return stages_ == scheme.stages && h_ == h; }
  void forget() { stages_ = 0; }

  /// r becomes the solution for the real eigenvalue.
  void solve_real(double* r) { real_.solver->solve(r); }
  /// re + i im becomes the solution for the eigenvalue alpha + i beta of pair k.
  void solve_pair(int k, double* re, double* im);

 private:
  template <class T>
  struct System {
    bool factor(const LinearStructure& structure, const std::vector<double>& jacobian, double h,
                T eigenvalue);

    std::vector<T> matrix;
    std::unique_ptr<FactorisationOf<T>> solver;
  };

  bool factor_real(const std::vector<double>& jacobian, const Scheme& scheme, double h);
  /// Factorises every second pair, from `first` on.
  bool factor_pairs(int first, const std::vector<double>& jacobian, const Scheme& scheme, double h);

  const LinearStructure* structure_;
  System<double> real_;
  std::array<System<Complex>, most_pairs> pairs_;
  std::vector<Complex> right_;
  unsigned cores_ = std::thread::hardware_concurrency();
  int stages_ = 0;  // of the last factorisation; 0: none
  double h_ = 0.0;
};

}  // namespace saltus::radau
