// LookPace: how far apart the looks at the guards of a step may be.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saltus/solver/detail/search_thresholds.hpp"

namespace saltus {

/// What four looks at a guard in a row say of the piece between the last two.
struct LookVariation {
  double error;  ///< of the parabola through the last three, in the last piece: an estimate
  double range;  ///< between the least and the greatest of the values
  double least;  ///< the distance from zero of the nearer of the last two; 0 if they differ in sign

  /// Whether the guard may have crossed zero where the looks do not show it.
  bool hides() const {
    return thresholds::hidden_room * error > least && error > thresholds::hidden_share * range;
  }
  /// Whether looks at twice the distance would show the guard, too.
  bool is_slow() const {
    return !(thresholds::growth_room * error > least &&
             error > thresholds::slow_share * thresholds::hidden_share * range);
  }
};

/// A guard may vary faster than the state, for which the method chooses its steps. So the distance
/// of the looks is controlled as the step of a method is: where a look shows that the guard varies
/// too fast, the piece is halved, and where it is slow the pieces grow again.
class LookPace {
 public:
  /// A run begins.
  void begin_run() { *this = {}; }

  /// Whether the evenly spaced looks, `even` [s] apart, are too far apart.
  bool is_finer_than(double even) const { return piece_ < even; }
  /// [s] How far the next look may be from one at the begin of the rest of a piece.
  double next(double rest) const {
    constexpr double less = 1.0 - 1e-9;  // a piece that a rounding made longer is not divided
    return rest * less <= piece_ ? rest : rest / std::ceil(rest / piece_ * less);
  }
  /// A piece of this length [s] hides something: whether it may be halved.
  bool halve(double length, double even) {
    if (0.5 * length < even * thresholds::finest_piece) return false;
    piece_ = 0.5 * length;
    return true;
  }
  /// A piece of this length [s] hid nothing.
  void accept(double length, bool slow) {
    if (slow && piece_ < all) piece_ = std::max(piece_, 2.0 * length);
  }
  /// A step that is looked into begins, with evenly spaced looks so far [s] apart. Returns whether
  /// it is the first of the run.
  bool begin_step(double even) {
    piece_ = std::max(piece_, even * thresholds::finest_piece);
    return std::exchange(is_new_, false);
  }

 private:
  static constexpr double all = std::numeric_limits<double>::infinity();
  double piece_ = all;  // [s]
  bool is_new_ = true;
};

/// Whether a guard counts for the distance of the looks. A guard that jumps, or whose values are
/// rounding, seems to hide something in the shortest pieces, too. If that happens often in a step,
/// the short pieces are of no use for this guard, so it does not count for some steps.
class Judged {
 public:
  bool yes() const { return rests_ == 0; }
  void begin_step() { in_vain_ = 0, rests_ = std::max(0, rests_ - 1); }
  /// The shortest piece hid something.
  void fail() {
    if (++in_vain_ > thresholds::most_in_vain) rests_ = thresholds::most_patience;
  }

 private:
  int in_vain_ = 0;  // shortest pieces in this step
  int rests_ = 0;    // steps that are looked into, until it counts again
};

}  // namespace saltus
