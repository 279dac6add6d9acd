// Descent: to the least value of a guard in a part of a step, by its slope.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saltus/solver/detail/search_thresholds.hpp"

namespace saltus {

/// The slope of a guard along the flow is zero where the guard is least. The secant through the last
/// two slopes leads there, and gains six tenths more digits with each (A. Ostrowski, "Solution of
/// Equations and Systems of Equations", 1960, ch. 3); the first step takes the bend of a parabola.
/// Where the secant leads out of the bracket, as at a kink, its middle is next.
class Descent {
 public:
  /// The part is [from, to]. The first look is at `first`, or at the end next to it.
  Descent(double from, double to, double first, double bend)
      : low_{.at = from},
        high_{.at = to},
        at_(std::clamp(first, from, to)),
        curvature_(2.0 * bend) {}

  /// Where to look next.
  double at() const { return at_; }

  /// Takes a look there: the value of the guard, and its slope a little later. Returns whether
  /// another look may show that the guard is beyond zero.
  bool take(double g, double slope, double later) {
    const End now{at_ + later, slope, true};
    if (last_.known) curvature_ = (now.slope - last_.slope) / (now.at - last_.at);
    last_ = now;
    (slope < 0.0 ? low_ : high_) = now;
    // The parabola with this slope and curvature comes so low.
    const bool opens = curvature_ > 0.0;
    if (opens && !(g - slope / (2.0 * curvature_) * slope <= thresholds::slow_dip * g))
      return false;
    const double before = std::exchange(at_, next());
    return at_ != before && low_.at < high_.at;
  }

 private:
  /// A place, and the slope there if it is known.
  struct End {
    double at = 0.0, slope = 0.0;
    bool known = false;
  };

  double next() const {
    const double u = curvature_ > 0.0    ? last_.at - last_.slope / curvature_
                     : last_.slope < 0.0 ? std::numeric_limits<double>::infinity()
                                         : -std::numeric_limits<double>::infinity();
    if (u > low_.at && u < high_.at) return u;
    const End& end = u >= high_.at ? high_ : low_;
    return end.known ? low_.at + 0.5 * (high_.at - low_.at) : end.at;
  }

  End low_, high_, last_ = {};
  double at_, curvature_;
};

}  // namespace saltus
