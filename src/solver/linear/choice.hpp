// Which linear solver suits a pattern.
#pragma once

#include <string>

#include "saltus/solver/detail/jacobian.hpp"
#include "saltus/solver/detail/linear_solver.hpp"
#include "saltus/solver/detail/ordering.hpp"

namespace saltus {

struct LinearChoice {
  LinearSolver solver = LinearSolver::dense;
  Bandwidth band = {};
  std::vector<int> position = {};  // of each state in the band; empty: as it is
  std::string why = {};            // "n = 20, ..."
};

/// The one that was asked for, or for automatic the one that is expected to be the fastest; docs:
/// choosing_a_solver.md.
LinearChoice choose_linear_solver(const Jacobian& jacobian, Index n, LinearSolver asked);

}  // namespace saltus
