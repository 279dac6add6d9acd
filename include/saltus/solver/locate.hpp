// Location: the earliest crossing of any guard inside one solver step, on the solver's own interpolant.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "saltus/plan/machine.hpp"
#include "saltus/solver/watch.hpp"

namespace saltus {

/// Looks at all guards in one vector call at a few interior points of a step (pairs of roots), then narrows the
/// first interval in which one crosses by the Illinois variant of regula falsi, guarded by bisection
/// (K. L. Hiebert and L. F. Shampine, "Implicitly defined output points for solutions of ODEs", Sandia report
/// SAND80-0180, 1980: the vector form, earliest root first). The end that is kept is always the one on the firing
/// side, so the state handed on is past the crossing or exactly on it.
/// Places inside the step are offsets u from its beginning, not times: the bracket ends below 2 eps u, finer than
/// any |t| allows, so that a state lands on its surface late in a long run as well as early.
class Locator {
 public:
  Locator(Machine& machine, Watch& watch)
      : machine_(&machine), watch_(&watch), x_(static_cast<std::size_t>(machine.plan().nx)) {
    const auto slots = static_cast<std::size_t>(machine.plan().guard_slots);
    for (auto* values : {&low_, &high_, &middle_}) values->assign(slots, 1.0);
  }

  /// The first offset in (from, to] at which a guard that is no monitor fires; false if there is none.
  /// The step begins at `t0`; `interpolate(u, x)` gives the state inside it, `end` is the state at `to` exactly.
  template <class Interpolate>
  bool find(double t0, double from, double to, const double* end, Interpolate&& interpolate) {
    t0_ = t0;
    const int pieces = watch_->scan_points + 1;
    const double start = from;
    for (int piece = 1; piece <= pieces; ++piece) {
      const bool last = piece == pieces;
      double next = last ? to : start + (to - start) * piece / pieces;
      if (next <= from) continue;
      while (look(next, last ? end : nullptr, interpolate, high_), watch_->any_crossed(high_)) {
        const double root = narrow(from, next, interpolate);
        if (take(root)) return true;
        from = root;  // only monitors: go on behind them
        if (root >= next) break;
      }
      if (from < next) accept(high_);
      from = next;
    }
    return false;
  }

  double offset() const noexcept { return root_; }

 private:
  /// All guards at offset u.
  template <class Interpolate>
  void look(double u, const double* known, Interpolate& interpolate, std::vector<double>& values) {
    if (known == nullptr) interpolate(u, x_.data());
    machine_->guards(t0_ + u, known == nullptr ? x_.data() : known, values.data());
  }

  void accept(const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (watch_->slots[k].active) watch_->follow(k, values[k]);
    }
  }

  /// Narrows [low, high], where no guard has fired at low and `high_` shows that one has at high.
  /// On return `high_` holds the guards at the time returned.
  template <class Interpolate>
  double narrow(double low, double high, Interpolate& interpolate) {
    low_ = watch_->g;
    int kept = 0;  // how often the same end was kept, with its sign: Illinois halves its value
    double weight = 1.0;
    for (int count = 0; count < 200; ++count) {
      const double resolution = 2.0 * std::numeric_limits<double>::epsilon() * high;
      if (high - low <= resolution || only_exact_zeros()) break;
      const double u = next_point(low, high, weight, resolution, count);
      if (!(u > low && u < high)) break;
      look(u, nullptr, interpolate, middle_);
      if (watch_->any_crossed(middle_)) {
        high = u, high_.swap(middle_);
        kept = kept > 0 ? kept + 1 : 1;
      } else {
        low = u, low_.swap(middle_);
        leave_zero();
        kept = kept < 0 ? kept - 1 : -1;
      }
      weight = kept > 1 ? weight * 0.5 : kept < -1 ? weight * 2.0 : 1.0;
    }
    return high;
  }

  /// A fresh guard seen on its armed side is an ordinary one from there on.
  void leave_zero() {
    for (std::size_t k = 0; k < low_.size(); ++k) {
      GuardSlot& slot = watch_->slots[k];
      if (slot.fresh && watch_->sign(k, low_[k]) == slot.side) slot.fresh = false, slot.band = 0.0;
    }
  }

  bool only_exact_zeros() const {
    for (std::size_t k = 0; k < high_.size(); ++k) {
      if (watch_->crossed(k, high_[k]) && high_[k] != 0.0) return false;
    }
    return true;
  }

  /// The secant point of the guard that seems to cross first, kept one resolution off the ends; the middle where
  /// the secant says nothing: guards that jump, or that are at zero at the low end.
  double next_point(double low, double high, double weight, double resolution, int count) const {
    double fraction = 2.0;  // of the interval, from low
    for (std::size_t k = 0; k < high_.size(); ++k) {
      if (!watch_->crossed(k, high_[k])) continue;
      const GuardSlot& slot = watch_->slots[k];
      const double a = std::abs(low_[k]) * weight, b = std::abs(high_[k]);
      const bool blind = slot.jumps || slot.fresh || !(a > 0.0) || !(a + b < std::numeric_limits<double>::infinity());
      fraction = std::min(fraction, blind ? 0.5 : a / (a + b));
    }
    if (count > 60) fraction = 0.5;
    if (high - low <= 3.0 * resolution) return low + 0.5 * (high - low);
    return std::clamp(low + fraction * (high - low), low + resolution, high - resolution);
  }

  /// Notes what fired at offset u; true if one of them is no monitor.
  bool take(double u) {
    root_ = u;
    watch_->fired.clear();
    bool stops = false;
    for (std::size_t k = 0; k < high_.size(); ++k) {
      if (watch_->crossed(k, high_[k])) {
        const Firing firing{static_cast<int>(k), watch_->slots[k].side};
        if (watch_->slots[k].monitor) {
          watch_->monitors.push_back({t0_ + u, firing});
        } else {
          watch_->fired.push_back(firing);
          stops = true;
        }
      }
    }
    for (std::size_t k = 0; k < high_.size(); ++k) {
      if (watch_->slots[k].active) watch_->follow(k, high_[k]);
      if (watch_->crossed(k, high_[k])) disarm(k);
    }
    return stops;
  }

  /// A guard exactly on zero after firing takes the side it leaves to.
  void disarm(std::size_t k) {
    watch_->slots[k].side = 0;
    watch_->g[k] = high_[k];
  }

  Machine* machine_;
  Watch* watch_;
  std::vector<double> x_, low_, high_, middle_;
  double t0_ = 0.0, root_ = 0.0;
};

}  // namespace saltus
