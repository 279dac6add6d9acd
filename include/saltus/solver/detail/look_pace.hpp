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
  bool jumps_once = false;  ///< it has two values, and changed once, in looks near to each other
  bool crosses = false;     ///< the last two values have different signs

  /// Whether the guard may have crossed zero where the looks do not show it.
  bool hides() const {
    return !jumps_once && varies(thresholds::hidden_room, thresholds::hidden_share);
  }
  /// Whether the looks do not show the guard, which may come to zero. They show a smooth guard where
  /// they are near enough, because its error falls by eight where the piece is halved.
  bool is_noise() const {
    return !jumps_once && varies(thresholds::growth_room, thresholds::hidden_share);
  }
  /// Whether looks at twice the distance would show the guard, too.
  bool is_slow() const {
    return !varies(thresholds::growth_room, thresholds::slow_share * thresholds::hidden_share);
  }

 private:
  /// Whether the guard is nearer to zero than `room` errors, and its error is more than `share` of its
  /// range.
  bool varies(double room, double share) const {
    return room * error > least && error > share * range;
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
  /// The part of a piece after which the next look inside of it is. It differs from piece to piece without a
  /// pattern: looks at one distance, or at two in turn, may have the period of the guard, and would show
  /// nothing of it from then on.
  double part() const { return 1.0 - thresholds::uneven_part * place_; }
  /// A piece of this length [s] hides something: whether it may be halved. No piece is shorter than
  /// `least` [s].
  bool halve(double length, double least) {
    if (0.5 * length < least) return false;
    piece_ = 0.5 * length;
    return true;
  }
  /// Looks must not be further apart than this [s] from here on.
  void limit(double longest) {
    longest_ = longest;
    piece_ = std::min(piece_, longest);
  }
  /// A piece of this length [s] hid nothing.
  void accept(double length, bool slow) {
    place_ += thresholds::golden_ratio - 1.0;
    place_ -= std::floor(place_);
    if (slow && piece_ < all) piece_ = std::min(longest_, std::max(piece_, 2.0 * length));
  }
  /// The same, up to `time`, where a guard follows the time. Such a guard may be slow for a while, as a sine of
  /// which the amplitude comes and goes: the longer no guard has crossed zero, the further apart the looks
  /// may be. `crosses`: whether one does in this piece.
  void accept(double length, bool slow, double time, bool crosses) {
    if (crosses) crossed_at_ = time, crossed_in_ = std::max(length, 0.5 * crossed_in_);
    const double limit = std::max(crossed_in_, thresholds::slow_time * (time - crossed_at_));
    accept(std::min(length, 0.5 * limit), slow);
  }
  /// Whether a step of this length [s] may pass without a look inside, where a guard follows the time.
  /// A method chooses its steps for the states, so they say nothing of such a guard: only the looks in
  /// a step that was hardly shorter do.
  bool shows(double length) const {
    return length <= thresholds::seen_growth * seen_ && !is_finer_than(length);
  }
  /// Whether the looks of a step have to be chosen anew, where a guard follows the time: before a
  /// restart no look says how fast the guard is after it, and where looks are as far apart as the even
  /// ones they may have the period of the guard.
  bool is_doubtful(double even, bool restarted) const { return restarted || !is_finer_than(even); }
  /// A step of this length [s] is looked into.
  void see(double length) { seen_ = length; }
  /// A step that is looked into begins, with evenly spaced looks so far [s] apart, and no piece
  /// shorter than `least` [s]. Returns whether its looks are much further apart than any before: then
  /// no look has shown yet how fast the guards are for them.
  bool begin_step(double even, double least) {
    piece_ = std::max(piece_, least);
    if (even <= thresholds::known_growth * widest_) return false;
    widest_ = even;
    return true;
  }

 private:
  static constexpr double all = std::numeric_limits<double>::infinity();
  double piece_ = all, longest_ = all;  // [s]
  double crossed_at_ = -all,
         crossed_in_ = 0.0;  // [s] the last piece with a crossing: its end, its length
  double place_ = 0.0;       // in [0, 1): multiples of the golden ratio
  double widest_ = 0.0;      // [s] between the looks of a step
  double seen_ = 0.0;        // [s] length of the last step that was looked into
};

/// Whether a guard counts for the distance of the looks. A guard that jumps, or whose values are
/// rounding, seems to hide something in the shortest pieces, too, and noise is shown by no piece. If
/// that happens often in a step, the short pieces are of no use for this guard, so it does not count
/// for some steps.
class Judged {
 public:
  bool yes() const { return rests_ == 0; }
  void begin_step() { in_vain_ = noise_ = 0, rests_ = std::max(0, rests_ - 1); }
  /// The shortest piece hid something.
  void fail() { rest_after(++in_vain_); }
  /// A piece of near looks seems to show noise. Noise does so again and again; a smooth guard does so
  /// until the pieces are short enough.
  void note(bool noise) { rest_after(noise_ = noise ? noise_ + 1 : 0); }

 private:
  void rest_after(int times) {
    if (times > thresholds::most_in_vain) rests_ = thresholds::most_patience;
  }
  int in_vain_ = 0;  // shortest pieces in this step
  int noise_ = 0;    // pieces in a row that seem to show noise
  int rests_ = 0;    // steps that are looked into, until it counts again
};

}  // namespace saltus
