// The choice of the linear solver for a pattern.
#pragma once

#include <string>

#include "saltus/solver/detail/jacobian.hpp"
#include "saltus/solver/detail/ordering.hpp"
#include "saltus/solver/linear_solver.hpp"

namespace saltus {

struct LinearChoice {
  LinearSolver solver = LinearSolver::dense;
  Bandwidth band = {};
  std::vector<int> position = {};  // of each state in the band; empty: natural order
  std::string why = {};            // "n = 20, ..."
  double time = 0.0;               // [ns] estimated, of a factorisation; 0: not known
};

/// Chooses the requested solver; for `automatic` the solver with the least estimated time (docs:
/// choosing_a_solver.md).
LinearChoice choose_linear_solver(const Jacobian& jacobian, Index n, LinearSolver asked);

}  // namespace saltus
