// Whether Newton's iteration of a step converges: a function of the sizes of its corrections.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/solver/detail/radau/tuning.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus::radau {

/// [iterations] 7, 12 and 17 (the code RADAU).
constexpr int most_iterations(int stages) { return 7 + 5 * (stages - 3) / 2; }

/// [tolerances] Some roundings of the states, if rtol of their size is the tolerance.
inline double rounding_of(double rtol) { return tuning::room_roundings * thresholds::eps / rtol; }
/// [tolerances] The error that the iteration may leave.
inline double newton_room(double rtol) { return std::max(tuning::newton_room, rounding_of(rtol)); }

/// The factor theta / (1 - theta) of a step, for a step `ratio` times as long; infinite if that
/// need not contract. An error E of the Jacobian gives the contraction |(Lambda - h J)^-1 h E|,
/// which is in proportion to h at most. A shorter step counts as one of the same length, because J
/// may have become worse meanwhile.
inline double scaled(double factor, double ratio) {
  if (ratio <= 1.0) return factor;
  const double theta = ratio / (1.0 + 1.0 / factor);
  return theta < tuning::no_contraction ? theta / (1.0 - theta)
                                        : std::numeric_limits<double>::infinity();
}

enum class Verdict {
  go_on,      ///< another iteration
  converged,  ///< the next correction would be below the tolerance of the iteration
  slow,       ///< it would need too many iterations
  diverged    ///< the corrections do not shrink
};

/// Follows the corrections d_1, d_2, ... of a simplified Newton iteration (Hairer, Wanner II, IV.8,
/// p. 120): the contraction theta is d_k / d_(k-1), from the third on the geometric mean of the
/// last two ratios; the error left after d_k is theta / (1 - theta) d_k.
class Convergence {
 public:
  /// `tolerance`: [tolerances] of the iteration; `rounding`: [tolerances] of a correction; `most`:
  /// iterations; `before`: theta / (1 - theta) of the step before, which judges the first
  /// correction; infinite if it says nothing. It counts as `least_factor` at least: what it was
  /// before does not bound what it is now.
  Convergence(double tolerance, double rounding, int most, double before)
      : tolerance_(tolerance),
        rounding_(rounding),
        most_(most),
        factor_(std::pow(std::max(before, tuning::least_factor), tuning::factor_power)) {}

  Verdict look(double correction) {
    ++iterations_;
    if (iterations_ > 1) {
      const double ratio = correction / last_;
      theta_ = iterations_ == 2 ? ratio : std::sqrt(ratio * last_ratio_);
      last_ratio_ = ratio;
      const bool shrinks = theta_ < tuning::no_contraction;
      at_rounding_ = !shrinks && correction <= rounding_;
      if (!shrinks && !at_rounding_) return Verdict::diverged;
      factor_ = shrinks ? theta_ / (1.0 - theta_) : 0.0;
    }
    last_ = correction;
    if (factor_ * correction <= tolerance_ || correction == 0.0) return Verdict::converged;
    if (iterations_ == most_) return Verdict::slow;
    if (iterations_ > 1 && remaining() > 1.0) return Verdict::slow;
    return Verdict::go_on;
  }

  int iterations() const { return iterations_; }
  double theta() const { return theta_; }
  double factor() const { return factor_; }
  /// Whether it converged only in so far as the corrections are so small that rounding may be the
  /// reason that they do not shrink.
  bool at_rounding() const { return at_rounding_; }
  /// Whether the Jacobian is good enough for the next step too (the code RADAU5).
  bool keeps_jacobian() const {
    return iterations_ <= tuning::keeps_iterations || theta_ <= tuning::keeps_to;
  }
  /// The part of the step with which the iteration would be fast enough (IV.8, p. 121). A slow
  /// iteration would leave more than its tolerance.
  double shorter() const {
    const double excess = std::min(remaining(), tuning::most_excess);
    return tuning::slow_safety * std::pow(excess, -1.0 / (3.0 + most_ - iterations_));
  }

 private:
  /// [tolerances] The error that the last allowed iteration would leave.
  double remaining() const {
    return factor_ * last_ * std::pow(theta_, most_ - 1 - iterations_) / tolerance_;
  }

  double tolerance_, rounding_;
  int most_;
  double factor_;  // theta / (1 - theta)
  int iterations_ = 0;
  bool at_rounding_ = false;
  double theta_ = 0.0, last_ = 0.0, last_ratio_ = 0.0;
};

}  // namespace saltus::radau
