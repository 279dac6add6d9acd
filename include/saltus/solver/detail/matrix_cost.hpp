// The cost of the matrices of a stiff method.
#pragma once

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

struct MatrixCost {
  bool direct = true;  ///< they can be factorised
  double time = 0.0;   ///< [ns] of one factorisation and its solves, by estimate
};

/// The cost at (t, x). It looks for the sparsity of blocks that declare none, so it may take some
/// hundred calls of a large block. Throws ModelError for an impossible sparsity.
MatrixCost matrix_cost(Machine& machine, const SolverOptions& options, double t,
                       const Eigen::VectorXd& x);

}  // namespace saltus
