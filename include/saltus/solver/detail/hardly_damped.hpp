// Hardly damped: whether a multistep method adds up errors in a fast part of a scene.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <string>

#include "saltus/base/error.hpp"
#include "saltus/solver/detail/cvode_thresholds.hpp"

namespace saltus::cvode {

/// The damping ratio below which BDF of this order amplifies a part for some step: the cosine of
/// its angle of stability, 86.03, 73.35 and 51.84 degrees for orders 3 to 5 (E. Hairer, G. Wanner,
/// "Solving Ordinary Differential Equations II", 1996, V.2, table 2.1). Orders 1 and 2 amplify
/// none.
inline double least_damping_of_bdf(int order) {
  constexpr std::array damping{0.0, 0.0, 0.0, 0.0692, 0.2865, 0.6179};
  return damping[static_cast<std::size_t>(std::clamp(order, 0, 5))];
}

/// Whether BDF amplifies a part with this h |lambda| and damping ratio, or nearly does. A part of a
/// smaller h |lambda| is followed, and one of a larger is damped by every order.
inline bool bdf_amplifies(int order, double reach, double damping) {
  return order > 2 && damping < least_damping_of_bdf(order) && reach > thresholds::followed_reach &&
         reach < thresholds::damped_reach;
}

/// Whether the convergence of Adams' corrector bounds its steps beside a part of this damping ratio:
/// nothing then damps the errors of the part. `failed` is the share of steps that it has shortened.
inline bool adams_is_bounded(double failed, double damping) {
  return failed > thresholds::bounded_share && damping < thresholds::undamped;
}

/// When to look, and how often such a part has been seen. The looks cost some calls of the
/// right-hand side: their number grows as the logarithm of that of the steps.
class Doubt {
 public:
  /// A run begins.
  void begin() { *this = {}; }
  /// A step was taken: whether it is time to look.
  bool is_due() {
    if (++steps_ < next_) return false;
    next_ *= 2;
    return true;
  }
  void note(bool seen, double rate) {
    if (seen) ++seen_, rate_ = std::max(rate_, rate);
  }
  /// A start or an event may excite such a part for some steps: one look is no reason.
  bool is_sure() const { return seen_ >= thresholds::looks_of_doubt; }
  double rate() const { return rate_; }  ///< [1/s] of the fastest part that was seen
  /// For the statistics.
  std::string words() const {
    std::ostringstream rate;
    rate << std::setprecision(2) << rate_;
    return text(
        "beside an oscillation of ", rate.str(),
        " rad/s that is hardly damped, whose errors may add up beyond the tolerance: compare "
        "with radau");
  }

 private:
  int steps_ = 0, next_ = thresholds::first_look_of_doubt, seen_ = 0;
  double rate_ = 0.0;
};

}  // namespace saltus::cvode
