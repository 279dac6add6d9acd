// Contraction: how fast the fixed-point iteration of Adams converges, and what its test gets.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/solver/detail/cvode_thresholds.hpp"

namespace saltus {

/// Follows the ratio q of two changes of the iteration, about h |lambda| beta for the fastest mode.
/// CVODE accepts any q up to 2, and a rest of 0.1 tolerances. The derivative at the end of the step
/// is then wrong by |lambda| times the rest. Near the imaginary axis nothing damps that, and the
/// errors of many steps add up: modes of -0.1 +- 1000i that are not excited, over 30 s, ended
/// 6 000 to 12 000 tolerances off without a word. So CVODE's test gets a smaller tolerance where q
/// is large, and a larger q is refused: CVODE takes a shorter step. With these numbers the same run
/// is within a tolerance, and +- 30i within 30 in place of 2000, for 1.01 times the calls of the
/// shelf (geometric mean; rtol 1e-4 to 1e-10).
class Contraction {
 public:
  /// Looks at a change of the iteration [tolerances], the first of a step or a later one;
  /// `tolerance` [tolerances] is that of the iteration. False if the iteration is too slow.
  bool look(double size, bool first, double tolerance) {
    using namespace thresholds;
    const double before = std::exchange(before_, size);
    if (first) return true;
    if (size > slowest_ratio * before && size > judged_change * tolerance) return false;
    ratio_ = std::max(ratio_memory * ratio_, std::min(size / before, slowest_ratio));
    return true;
  }
  /// [1] The part of its tolerance that the iteration gets.
  double share() const {
    const double fast = thresholds::fast_ratio;
    return ratio_ <= fast ? 1.0 : std::pow(fast / ratio_, 3) * (1.0 - ratio_);
  }
  /// [1] q, as it is remembered.
  double ratio() const noexcept { return ratio_; }

 private:
  double ratio_ = 0.0;
  double before_ = 0.0;  // [tolerances] the change before
};

}  // namespace saltus
