// The Floquet multipliers of an orbit, and what they say about the result.
#pragma once

#include "closing.hpp"

namespace saltus {

struct Multipliers {
  Eigen::VectorXcd values;  ///< the largest first; of an autonomous system without the trivial one
  double trivial = 0.0;     ///< NaN for a driven system
  bool isolated = true;     ///< no multiplier is 1, so the orbit is not one of many
  std::vector<std::string> notes = {};
};

/// The eigenvalues of the monodromy matrix M; for an autonomous system those of M on the states
/// modulo the flow f: M f = f, so with columns Q across f the others are those of Q^T M Q.
Multipliers multipliers_of(const Closing& closing, const Arc& arc);

/// The eigenvalues of a matrix, the largest first.
Eigen::VectorXcd largest_first(const Eigen::MatrixXd& matrix);

}  // namespace saltus
