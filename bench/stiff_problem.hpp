// A stiff problem as plain functions, which any program can solve, and as a leaf of Saltus.
#pragma once

#include "saltus/saltus.hpp"

namespace bench {

/// x' = f(t, x), written by hand.
struct StiffProblem {
  const char* name;
  Eigen::VectorXd start;
  double t_end;
  void (*f)(double t, const double* x, double* xdot, long n);
  void (*jacobian)(double t, const double* x, double* j) = nullptr;  ///< dense, by columns
  long band = -1;                                                    ///< of it; -1: dense
};

/// The same problem as a leaf: a band is declared as the sparsity, the Jacobian directly.
class StiffLeaf final : public saltus::LeafSystem {
 public:
  explicit StiffLeaf(const StiffProblem& problem) : LeafSystem(problem.name) {
    using saltus::At, saltus::VectorRef, saltus::MatrixRef;
    const auto n = problem.start.size();
    declare_continuous_state(
        {.initial = problem.start, .ode = [f = problem.f, n](const At& at, VectorRef xdot) {
           f(at.time, at.x.data(), xdot.data(), static_cast<long>(n));
         }});
    declare_continuous_state_output("y");
    if (problem.jacobian != nullptr)
      declare_jacobian([j = problem.jacobian](const At& at, MatrixRef out) {
        j(at.time, at.x.data(), out.data());
      });
    if (problem.band >= 0)
      declare_jacobian_sparsity(saltus::band_entries(n, problem.band, problem.band));
  }
};

}  // namespace bench
