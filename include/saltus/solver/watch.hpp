// Watch: on which side of zero every guard is armed, shared by the engine (which arms) and the solver (which looks).
#pragma once

#include <cmath>
#include <vector>

#include "saltus/model/event.hpp"

namespace saltus {

/// One guard as the solver sees it.
struct GuardSlot {
  Direction direction = Direction::crosses_zero;
  signed char side = 0;   ///< +1, -1: armed there; 0: no side yet, the first one it takes is its own
  bool active = false;    ///< can fire in the present modes
  bool fresh = false;     ///< at zero when integration began: it fires only after leaving zero for `side`
  bool monitor = false;   ///< located and logged, stops nothing
  bool jumps = false;     ///< takes only two values: located by bisection
  double band = 0.0;      ///< a fresh guard within it is still at zero
  double base = 0.0;      ///< edge_detection: the value it had
};

/// A guard that fired, and the side it came from.
struct Firing {
  int slot = -1;
  int from = 0;
};

/// A monitor's crossing inside the last step.
struct MonitorHit {
  double t = 0.0;
  Firing firing = {};
};

/// All guards of a run.
struct Watch {
  std::vector<GuardSlot> slots;
  std::vector<double> g;            ///< values at the last time looked at
  std::vector<Firing> fired;        ///< what crossed at the last root
  std::vector<MonitorHit> monitors; ///< hits in the last advance
  int scan_points = 3;              ///< interior points of a step at which guards are looked at
  bool any = false;                 ///< some slot is active

  int sign(std::size_t k, double value) const {
    if (std::abs(value) <= slots[k].band) return 0;
    return (value > 0.0) - (value < 0.0);
  }

  /// Whether slot k has fired when its guard has this value.
  bool crossed(std::size_t k, double value) const {
    const GuardSlot& slot = slots[k];
    if (!slot.active) return false;
    if (slot.direction == Direction::edge_detection) return value != slot.base;
    if (slot.side == 0) return false;
    const int now = sign(k, value);
    // A fresh guard at zero has not left it: only the strict far side counts.
    return (now != 0 || !slot.fresh) && fires(slot.direction, slot.side, now);
  }

  bool any_crossed(const std::vector<double>& values) const {
    for (std::size_t k = 0; k < slots.size(); ++k) {
      if (crossed(k, values[k])) return true;
    }
    return false;
  }

  /// Takes over sides after a look at which slot k did not fire.
  void follow(std::size_t k, double value) {
    GuardSlot& slot = slots[k];
    g[k] = value;
    slot.base = value;
    if (const int now = sign(k, value); now != 0) {
      slot.side = static_cast<signed char>(now);
      slot.fresh = false;
      slot.band = 0.0;
    }
  }
};

}  // namespace saltus
