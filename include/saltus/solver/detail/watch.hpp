// Watch: on which side of zero every guard is armed, shared by the engine (which arms) and the
// solver (which looks).
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "saltus/model/event.hpp"

namespace saltus {

/// The side a guard fires on reaching; for either direction the lower one.
constexpr int firing_side(Direction direction) {
  return direction == Direction::negative_then_non_negative ? 1 : -1;
}

/// One guard as the solver sees it.
struct GuardSlot {
  Direction direction = Direction::crosses_zero;
  signed char side = 0;  ///< +1, -1: armed there; 0: no side yet, the first one it takes is its own
  bool active = false;   ///< can fire in the present modes
  bool fresh =
      false;  ///< at zero when integration began: it fires only after leaving zero for `side`
  bool monitor = false;  ///< located and logged, stops nothing
  bool jumps = false;    ///< takes only two values: located by bisection
  bool leaving = false;  ///< of a block at rest: fires on leaving the band, to either side
  double band = 0.0;     ///< a guard within it is still at zero, and waits like a fresh one
  double base = 0.0;     ///< edge_detection: the value it had

  int sign(double value) const {
    if (std::abs(value) <= band) return 0;
    return (value > 0.0) - (value < 0.0);
  }

  /// Whether it has to be clearly off zero before it can fire. Not only a fresh one: one that fires
  /// within its band would fire early, by the whole band, or again at once.
  bool waits() const noexcept { return fresh || band > 0.0; }

  /// Whether it has fired when its guard has this value.
  bool crossed(double value) const {
    if (leaving) return std::abs(value) > band;
    if (direction == Direction::edge_detection) return value != base;
    const int now = sign(value);
    // A guard at zero that waits has not left it: only the strict far side counts.
    return side != 0 && (now != 0 || !waits()) && fires(direction, side, now);
  }

  /// Where it fires: at values <= first or >= second. The same as crossed(), for many values.
  std::pair<double, double> limits() const {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (leaving) return {-std::nextafter(band, never), std::nextafter(band, never)};
    if (direction == Direction::edge_detection)
      return {std::nextafter(base, -never), std::nextafter(base, never)};
    const double reach = band > 0.0 ? std::nextafter(band, never)
                         : fresh    ? std::numeric_limits<double>::denorm_min()
                                    : 0.0;
    const bool falls = side > 0 && fires(direction, 1, -1),
               rises = side < 0 && fires(direction, -1, 1);
    return {falls ? -reach : -never, rises ? reach : never};
  }

  /// The side of a guard of which there is nothing to know but whether it stays there; else 0.
  double plain_side() const noexcept {
    const bool plain = !waits() && !leaving && direction != Direction::edge_detection;
    return plain ? side : 0;
  }

  /// Takes over the side after a look at which it did not fire.
  void follow(double value) {
    base = value;
    if (leaving) return;
    if (const int now = sign(value); now != 0) {
      side = static_cast<signed char>(now);
      fresh = false;
      band = 0.0;
    }
  }
};

/// A guard that fired, and the side it came from.
struct Firing {
  int slot = -1;
  int from = 0;
  bool fresh = false;  ///< it had not been clearly off zero since integration began
};

/// A monitor's crossing inside the last step.
struct MonitorHit {
  double t = 0.0;
  Firing firing = {};
};

/// All guards of a run.
struct Watch {
  std::vector<GuardSlot> slots;
  std::vector<std::size_t> active;   ///< slots that can fire in the present modes
  std::vector<double> g;             ///< values at the last time looked at
  std::vector<Firing> fired;         ///< what crossed at the last root
  std::vector<MonitorHit> monitors;  ///< hits in the last advance
  std::int64_t version = 0;          ///< counts up whenever the engine changes slots
  int scan_points = 3;               ///< interior points of a step at which guards are looked at

  bool any() const noexcept { return !active.empty(); }
  int sign(std::size_t k, double value) const { return slots[k].sign(value); }
  bool crossed(std::size_t k, double value) const {
    return slots[k].active && slots[k].crossed(value);
  }
  void follow(std::size_t k, double value) {
    g[k] = value;
    slots[k].follow(value);
  }
};

}  // namespace saltus
