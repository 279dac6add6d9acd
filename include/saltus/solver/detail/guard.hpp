// Guard: the record of one guard of a run, and the rule when it fires.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "saltus/model/event.hpp"
#include "saltus/plan/rate.hpp"
#include "saltus/solver/detail/edge_series.hpp"

namespace saltus {

/// The side on which a guard fires; the lower side for a guard of either direction.
constexpr int firing_side(Direction direction) {
  return direction == Direction::negative_then_non_negative ? 1 : -1;
}

/// The sign of a value: -1, 0 or +1.
constexpr signed char sign_of(double value) {
  return static_cast<signed char>((value > 0.0) - (value < 0.0));
}

/// The value of armed_at for a guard that does not wait after a firing.
inline constexpr double not_armed = std::numeric_limits<double>::quiet_NaN();

/// How a guard is watched while the solver works.
enum class Phase : signed char {
  unseen,   ///< no side yet: its first sign becomes its side
  armed,    ///< on its side: fires on reaching zero or the other side, in its direction
  waiting,  ///< at zero within its error: fires only after it has left zero for its side
  resting,  ///< its block is at rest: fires on leaving its error, to either side
  carried   ///< its block moves with a surface; its value is the lift, and fires on rising to zero
};

/// How a guard was declared.
struct GuardTraits {
  Direction direction = Direction::crosses_zero;
  bool monitor = false;                        ///< located and logged, stops nothing
  bool jumps = false;                          ///< takes only two values: located by bisection
  bool stepped = false;                        ///< may be constant while the state varies
  FollowsTime follows_time = FollowsTime::no;  ///< yes also for a guard that turns by a state
  int group = -1;                              ///< index in the plan's list of guards
  int entry = 0;                               ///< index in that group
};

/// The record of one guard. GuardSet is its only writer.
///
///     phase      side        error
///     unseen     0           from an earlier stay in its mode
///     armed      +1, -1      0; above 0 until the next look where a guard fires by decision
///     waiting    +1, -1, 0   the guard counts as zero within it; side 0: the side it leaves to
///     resting    +1, -1, 0   the guard counts as zero within it
///     carried    -1          0
struct Guard : GuardTraits {
  Phase phase = Phase::unseen;
  signed char side = 0;         ///< +1, -1, or 0 for none: see the table
  signed char came_from = 0;    ///< the side the last firing came from
  bool active = false;          ///< can fire in the present modes
  bool was_active = false;      ///< could fire in the modes before
  bool rests = false;           ///< a relation that keeps its truth while its blocks rest
  double error = 0.0;           ///< the guard is at zero within it
  double base = 0.0;            ///< edge_detection: fires at any other value
  double armed_at = not_armed;  ///< [s] when it began to wait after a firing
  double clear_at = not_armed;  ///< [s] when the flow has taken it clearly off zero after that
  double doubted = 0.0;         ///< its error at its last false root since then
  EdgeSeries edges = {};        ///< edge_detection: its last firings inside steps

  /// The direction in which it is watched: the direction of the lift while its block is carried.
  Direction watched_direction() const {
    return phase == Phase::carried ? Direction::negative_then_non_negative : direction;
  }

  /// The sign of a value; 0 within the error.
  int sign(double value) const { return std::abs(value) <= error ? 0 : sign_of(value); }

  /// Whether it has not been seen off zero since integration began.
  bool at_zero() const noexcept { return phase == Phase::waiting || phase == Phase::resting; }

  /// Whether it has to be clearly off zero before it can fire. A firing within its error would be
  /// early by the whole error, or would be repeated at once.
  bool waits() const noexcept { return at_zero() || error > 0.0; }

  /// Whether it fires in one direction only: the other side of zero is its armed side.
  bool has_one_direction() const noexcept {
    return direction == Direction::positive_then_non_positive ||
           direction == Direction::negative_then_non_negative;
  }
  /// Whether it has one direction, and is on its firing side.
  bool is_beyond() const noexcept { return has_one_direction() && side == firing_side(direction); }

  /// Whether it fires at this value.
  bool crossed(double value) const {
    if (phase == Phase::resting) return std::abs(value) > error;
    const Direction watched = watched_direction();
    if (watched == Direction::edge_detection) return phase != Phase::unseen && value != base;
    const int now = sign(value);
    // A guard that waits at zero has not left it: only the strict far side counts.
    return side != 0 && (now != 0 || !waits()) && fires(watched, side, now);
  }

  /// It fires at values <= first or >= second. This is crossed() in another form, for many values.
  [[gnu::always_inline]] std::pair<double, double> limits() const {
    if (phase != Phase::armed || error > 0.0 || direction == Direction::edge_detection)
      return limits_within_error();
    constexpr double never = std::numeric_limits<double>::infinity();
    return {side > 0 && fires(direction, 1, -1) ? 0.0 : -never,
            side < 0 && fires(direction, -1, 1) ? 0.0 : never};
  }

  void set(Phase now, int on, double within) {
    phase = now, side = static_cast<signed char>(on), error = within;
  }
  /// Sets the side; 0 for none. The phase changes only if the guard did not wait.
  void turn(int to) {
    side = static_cast<signed char>(to);
    if (phase != Phase::unseen && phase != Phase::armed) return;
    const bool has_side = to != 0 || direction == Direction::edge_detection;
    phase = has_side ? Phase::armed : Phase::unseen;
  }
  /// Sets a side without an error.
  void settle(int on) {
    side = static_cast<signed char>(on);
    if (phase != Phase::carried) phase = Phase::armed;
    error = 0.0;
  }

  /// Whether it is armed, off zero, and on its side at this value, so that neither a look nor arming
  /// changes more of its record than its base. Only the value of edge_detection has no side.
  bool stays(double value) const noexcept {
    return phase == Phase::armed && error == 0.0 && side * value > 0.0 &&
           direction != Direction::edge_detection;
  }

  /// The side, if only staying on it matters for this guard; otherwise 0.
  double plain_side() const noexcept {
    return waits() || watched_direction() == Direction::edge_detection ? 0.0 : side;
  }

 private:
  /// The limits of a guard in any phase, of any direction.
  [[gnu::noinline]] std::pair<double, double> limits_within_error() const {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (phase == Phase::resting)
      return {-std::nextafter(error, never), std::nextafter(error, never)};
    const Direction watched = watched_direction();
    if (watched == Direction::edge_detection && phase == Phase::unseen) return {-never, never};
    if (watched == Direction::edge_detection)
      return {std::nextafter(base, -never), std::nextafter(base, never)};
    const double reach = error > 0.0               ? std::nextafter(error, never)
                         : phase == Phase::waiting ? std::numeric_limits<double>::denorm_min()
                                                   : 0.0;
    const bool falls = side > 0 && fires(watched, 1, -1), rises = side < 0 && fires(watched, -1, 1);
    return {falls ? -reach : -never, rises ? reach : never};
  }
};

/// A guard that fired, and the side it came from.
struct Firing {
  static constexpr int lifts_off = 2;  ///< instead of a side: the flow leads off a contact
  int slot = -1;
  int from = 0;
  bool at_zero = false;  ///< it has not been clearly off zero since integration began
  double jump = 0.0;     ///< the size of its jump, if it seems to jump across zero

  /// The number of the guard in the GuardSet.
  std::size_t guard() const { return static_cast<std::size_t>(slot); }
};

/// A monitor's crossing inside the last step.
struct MonitorHit {
  double t = 0.0;
  Firing firing = {};
};

}  // namespace saltus
