// Location: the earliest crossing of any guard inside one solver step, on the solver's own
// interpolant.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "saltus/plan/machine.hpp"
#include "saltus/solver/watch.hpp"

namespace saltus {

/// Looks at all guards in one vector call at a few interior points of a step (pairs of roots), then
/// narrows the first interval in which one crosses by the Illinois variant of regula falsi, guarded
/// by bisection (K. L. Hiebert and L. F. Shampine, "Implicitly defined output points for solutions
/// of ODEs", Sandia report SAND80-0180, 1980: the vector form, earliest root first). The end that
/// is kept is always the one on the firing side, so the state handed on is past the crossing or
/// exactly on it. Places inside the step are offsets u from its beginning, not times: the bracket
/// ends below 2 eps u, finer than any |t| allows, so that a state lands on its surface late in a
/// long run as well as early.
class Locator {
 public:
  Locator(Machine& machine, Watch& watch)
      : machine_(&machine), watch_(&watch), x_(static_cast<std::size_t>(machine.plan().nx)) {
    const auto slots = static_cast<std::size_t>(machine.plan().guard_slots);
    for (auto* values : {&low_, &high_, &middle_}) values->assign(slots, 1.0);
    crossed_.reserve(slots), limits_.reserve(slots);
  }

  /// The first offset in (from, to] at which a guard that is no monitor fires; false if there is
  /// none. The step begins at `t0`; `interpolate(u, x)` gives the state inside it, `end` is the
  /// state at `to` exactly.
  template <class Interpolate>
  bool find(double t0, double from, double to, const double* end, const Interpolate& interpolate) {
    t0_ = t0;
    limits_.clear();
    for (std::size_t k : watch_->active) limits_.push_back(watch_->slots[k].limits());
    const int pieces = watch_->scan_points + 1;
    const double piece_length = (to - from) / pieces;
    for (int piece = 1; piece <= pieces; ++piece) {
      const bool last = piece == pieces;
      const double next = last ? to : std::min(to, from + piece_length);
      if (!find_in(from, next, last ? end : nullptr, interpolate)) {
        from = next;
        continue;
      }
      return true;
    }
    return false;
  }

  double offset() const noexcept { return root_; }

 private:
  /// The same without points in between; monitors are noted and passed.
  template <class Interpolate>
  bool find_in(double from, double to, const double* end, const Interpolate& interpolate) {
    while (from < to) {
      look(to, end, interpolate, high_);
      if (!note_crossed(high_)) {
        follow();
        return false;
      }
      from = narrow(from, to, interpolate);
      if (take(from)) return true;
    }
    return false;
  }

  /// All guards at offset u.
  template <class Interpolate>
  void look(double u, const double* known, const Interpolate& interpolate,
            std::vector<double>& values) {
    if (known == nullptr) interpolate(u, x_.data());
    machine_->guards(t0_ + u, known == nullptr ? x_.data() : known, values.data());
  }

  bool fired(std::size_t i, const std::vector<double>& values) const {
    const double value = values[watch_->active[i]];
    return value <= limits_[i].first || value >= limits_[i].second;
  }

  /// Whether some guard has crossed at these values; if so, crossed_ says which.
  bool note_crossed(const std::vector<double>& values) {
    const std::size_t count = limits_.size();
    std::size_t i = 0;
    while (i < count && !fired(i, values)) ++i;
    if (i == count) return false;
    crossed_.clear();
    for (; i < count; ++i) {
      if (fired(i, values)) crossed_.push_back(watch_->active[i]);
    }
    return true;
  }

  /// Takes over the sides at high_, where nothing fired.
  void follow() {
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const std::size_t k = watch_->active[i];
      GuardSlot& slot = watch_->slots[k];
      const bool stays =
          !slot.waits() && (slot.side > 0 ? high_[k] > 0.0 : slot.side < 0 && high_[k] < 0.0);
      watch_->g[k] = high_[k];
      if (stays) continue;
      if (std::isnan(high_[k])) throw_not_a_number(k);
      slot.follow(high_[k]);
      limits_[i] = slot.limits();
    }
  }

  [[noreturn]] void throw_not_a_number(std::size_t k) const {
    const auto holds = [k](const GuardGroup& g) {
      return static_cast<Index>(k) >= g.slot && static_cast<Index>(k) < g.slot + g.size;
    };
    const GuardGroup& group = *std::ranges::find_if(machine_->plan().guards, holds);
    throw SimulationError(text("t = ", t0_, " s: guard '", group.name,
                               "' is not finite (NaN) in the step that begins here; "
                               "check it at this state"),
                          t0_, machine_->plan().leaves[static_cast<std::size_t>(group.leaf)].path);
  }

  /// Narrows [low, high], where no guard has fired at low and `high_` shows that one has at high.
  /// On return `high_` and crossed_ are those of the offset returned.
  template <class Interpolate>
  double narrow(double low, double high, const Interpolate& interpolate) {
    low_ = watch_->g;
    int kept = 0;   // how often in a row the low (> 0) or high (< 0) end was kept: Illinois halves
                    // its value
    int zeros = 0;  // looks in a row that found nothing but exact zeros
    double weight = 1.0;
    for (int count = 0; count < 200; ++count) {
      const double resolution = 2.0 * std::numeric_limits<double>::epsilon() * high;
      if (high - low <= resolution) break;
      zeros = only_exact_zeros() ? zeros + 1 : 0;
      // A root hit exactly: one look just before it. If that is zero too, a plateau is halved down
      // to its beginning.
      const double u = zeros == 1  ? high - resolution
                       : zeros > 1 ? low + 0.5 * (high - low)
                                   : next_point(low, high, weight, resolution, count);
      if (!(u > low && u < high)) break;
      look(u, nullptr, interpolate, middle_);
      if (note_crossed(middle_)) {
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

  /// A guard that waits, seen on its armed side, is an ordinary one from there on.
  void leave_zero() {
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      GuardSlot& slot = watch_->slots[watch_->active[i]];
      if (!slot.waits() || slot.sign(low_[watch_->active[i]]) != slot.side) continue;
      slot.fresh = false, slot.band = 0.0;
      limits_[i] = slot.limits();
    }
  }

  bool only_exact_zeros() const {
    return std::ranges::all_of(crossed_, [&](std::size_t k) { return high_[k] == 0.0; });
  }

  /// The secant point of the guard that seems to cross first, kept one resolution off the ends; the
  /// middle where the secant says nothing: guards that jump, or that are at zero at the low end.
  double next_point(double low, double high, double weight, double resolution, int count) const {
    if (high - low <= 3.0 * resolution || count > 60) return low + 0.5 * (high - low);
    double fraction = 2.0;  // of the interval, from low
    for (std::size_t k : crossed_) {
      const GuardSlot& slot = watch_->slots[k];
      const double a = std::abs(low_[k]) * weight, b = std::abs(high_[k]);
      const bool blind = slot.jumps || slot.waits() || !(a > 0.0) ||
                         !(a + b < std::numeric_limits<double>::infinity());
      fraction = std::min(fraction, blind ? 0.5 : a / (a + b));
    }
    return std::clamp(low + fraction * (high - low), low + resolution, high - resolution);
  }

  /// Notes what fired at offset u; true if one of them is no monitor.
  bool take(double u) {
    root_ = u;
    watch_->fired.clear();
    for (std::size_t k : crossed_) {
      const GuardSlot& slot = watch_->slots[k];
      const Firing firing{static_cast<int>(k), slot.side};
      if (slot.monitor)
        watch_->monitors.push_back({t0_ + u, firing});
      else
        watch_->fired.push_back(firing);
    }
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const std::size_t k = watch_->active[i];
      GuardSlot& slot = watch_->slots[k];
      watch_->follow(k, high_[k]);
      if (slot.crossed(high_[k])) slot.side = 0;  // exactly on zero: it takes the side it leaves to
      limits_[i] = slot.limits();
    }
    return !watch_->fired.empty();
  }

  Machine* machine_;
  Watch* watch_;
  std::vector<double> x_, low_, high_, middle_;
  std::vector<std::size_t> crossed_;
  std::vector<std::pair<double, double>> limits_;  // of the active slots
  double t0_ = 0.0, root_ = 0.0;
};

}  // namespace saltus
