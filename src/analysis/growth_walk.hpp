// A long run in pieces, with the growth of each direction in each of them.
#pragma once

#include <optional>

#include "pieces.hpp"

namespace saltus {

/// ln r_ii of each piece, with D Q = Q' R.
struct Growth {
  Eigen::VectorXd durations;  ///< (pieces,) [s]
  Eigen::MatrixXd logs;  ///< (pieces, directions); -infinity where an event leaves nothing of one
  Index aligned = 0;     ///< the number of the first pieces that do not count
  Context end;
};

/// Carries `directions` orthonormal vectors along the run of `time` seconds from `start`, and makes
/// them orthonormal again after each piece. Empty where labels turn out to be none.
std::optional<Growth> walk(Pieces& pieces, const Context& start, double time, double longest,
                           Index directions);

}  // namespace saltus
