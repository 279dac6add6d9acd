// Location: the earliest crossing of any guard inside one solver step, on the solver's own
// interpolant.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/plan/machine.hpp"
#include "saltus/solver/dip.hpp"
#include "saltus/solver/watch.hpp"

namespace saltus {

/// Looks at all guards in one vector call at a few interior points of a step, and where three looks
/// say that a guard dips across zero and back (pairs of roots), then
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
    for (auto* values : {&low_, &high_, &middle_, &earlier_, &at_root_, &before_, &noise_})
      values->assign(slots, 1.0);
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
      if (find_in(from, next, last ? end : nullptr, interpolate)) return true;
      from = next;
    }
    earlier_at_ -= to;  // seen from the next step
    return false;
  }

  /// Begins anew: what was seen of the guards before a restart says nothing.
  void forget() { earlier_at_ = never; }

  double offset() const noexcept { return root_; }

 private:
  /// The same without points in between, save where a guard seems to dip across zero and back;
  /// monitors are noted and passed.
  template <class Interpolate>
  bool find_in(double from, double to, const double* end, const Interpolate& interpolate,
               bool between = true) {
    while (from < to) {
      look(to, end, interpolate, high_);
      double high = to;
      if (!note_crossed(high_)) {
        const double dip = watch_->scan_points > 0 ? find_dip(from, to, interpolate) : never;
        if (dip == never) {
          shift(from);
          follow();
          return false;
        }
        high = dip;
        high_.swap(middle_);
        if (!note_crossed(high_)) {  // to the side on which it does not fire
          shift(from);
          follow();
          from = dip;
          continue;
        }
      }
      const double before = from;
      before_ = watch_->g;
      from = narrow(from, high, interpolate);
      if (between && watch_->active.size() > 1 && watch_->scan_points > 0) {
        if (find_before(before, from, interpolate)) return true;
      } else if (from - before > 1e-3 * (to - before)) {
        earlier_.swap(before_);
        earlier_at_ = before;
      }
      if (take(from)) return true;
      leave_zero_of_monitors(from, to, interpolate);
    }
    return false;
  }

  /// The same for what lies before a root: it cuts the step, and what was looked at were points of
  /// the longer one. Afterwards `high_` and crossed_ are those of the root again.
  template <class Interpolate>
  bool find_before(double from, double root, const Interpolate& interpolate) {
    at_root_ = high_;
    const double piece = (root - from) / (watch_->scan_points + 1);
    for (int i = 1; i <= watch_->scan_points; ++i) {
      const double next = std::min(root, from + piece);
      if (find_in(from, next, nullptr, interpolate, false)) return true;
      from = next;
    }
    high_ = at_root_;
    note_crossed(high_);
    return false;
  }

  /// A monitor located exactly on zero: the side it leaves to, a hair further on.
  template <class Interpolate>
  void leave_zero_of_monitors(double from, double to, const Interpolate& interpolate) {
    const auto unsure = [&](std::size_t k) { return watch_->slots[k].side == 0; };
    if (std::ranges::none_of(crossed_, unsure)) return;
    const double resolution = std::numeric_limits<double>::epsilon() * (std::abs(t0_) + from);
    look(std::min(to, from + std::max(64.0 * resolution, 1e-9 * (to - from))), nullptr, interpolate,
         middle_);
    for (const std::size_t k : crossed_) {
      GuardSlot& slot = watch_->slots[k];
      if (slot.side == 0)
        slot.side = static_cast<signed char>((middle_[k] > 0.0) - (middle_[k] < 0.0));
    }
    for (std::size_t i = 0; i < limits_.size(); ++i)
      limits_[i] = watch_->slots[watch_->active[i]].limits();
  }

  /// The look at `from` is the one before the next look.
  void shift(double from) {
    earlier_ = watch_->g;
    earlier_at_ = from;
  }

  /// Where between two looks a guard seems to cross zero and come back: the vertex of the parabola
  /// through three looks, moved by successive parabolic interpolation (R. P. Brent, "Algorithms for
  /// Minimization without Derivatives", 1973, ch. 5) until the guard there is beyond zero.
  /// `middle_` then holds the guards at that offset; `never` if there is no such place.
  template <class Interpolate>
  double find_dip(double from, double to, const Interpolate& interpolate) {
    if (earlier_at_ == never) return never;
    for (const std::size_t k : watch_->active) {
      const GuardSlot& slot = watch_->slots[k];
      if (slot.side == 0 || slot.fresh || slot.jumps || slot.leaving) continue;
      Dip dip{{earlier_at_, from, to},
              {slot.side * earlier_[k], slot.side * watch_->g[k], slot.side * high_[k]}};
      // A touch within rounding is none; nor is a vertex far above zero.
      const double size = std::max({dip.g[0], dip.g[1], dip.g[2]});
      double u = dip.vertex(0.25 * size);
      for (int round = 0; round < 6 && u > from && u < to; ++round) {
        look(u, nullptr, interpolate, middle_);
        const double g = slot.side * middle_[k];
        if (g < -1e-12 * size) return u;
        dip.replace(u, g);
        u = dip.vertex(0.5 * dip.g[1]);
      }
    }
    return never;
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
    return !(value > limits_[i].first && value < limits_[i].second);  // so does what is not finite
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
      slot.follow(high_[k]);
      limits_[i] = slot.limits();
    }
  }

  [[noreturn]] void throw_not_finite(std::size_t k, double t) const {
    const auto holds = [k](const GuardGroup& g) {
      return static_cast<Index>(k) >= g.slot && static_cast<Index>(k) < g.slot + g.size;
    };
    const GuardGroup& group = *std::ranges::find_if(machine_->plan().guards, holds);
    throw SimulationError(text("t = ", t, " s: guard '", group.name,
                               "' is not finite (NaN or Inf); check it at this state"),
                          t, machine_->plan().leaves[static_cast<std::size_t>(group.leaf)].path);
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
    for (const std::size_t k : crossed_)
      noise_[k] = 4.0 * std::max(std::abs(low_[k]), std::abs(high_[k]));
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

  /// A monitor goes over to the other side, and is at zero until it is clearly off.
  void pass_monitor(GuardSlot& slot, const Firing& firing, double u) {
    const auto k = static_cast<std::size_t>(firing.slot);
    watch_->monitors.push_back({t0_ + u, firing});
    if (slot.direction == Direction::edge_detection) return;
    slot.side = static_cast<signed char>((high_[k] > 0.0) - (high_[k] < 0.0));
    slot.fresh = true, slot.band = noise_[k];
  }

  /// Notes what fired at offset u; true if one of them is no monitor.
  bool take(double u) {
    root_ = u;
    watch_->fired.clear();
    for (std::size_t k : crossed_) {
      GuardSlot& slot = watch_->slots[k];
      if (!std::isfinite(high_[k])) throw_not_finite(k, t0_ + u);
      const Firing firing{static_cast<int>(k), slot.side, slot.fresh};
      if (slot.monitor)
        pass_monitor(slot, firing, u);
      else
        watch_->fired.push_back(firing);
    }
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const std::size_t k = watch_->active[i];
      GuardSlot& slot = watch_->slots[k];
      watch_->follow(k, high_[k]);
      // Exactly on zero it takes the side it leaves to.
      if (!slot.leaving && slot.crossed(high_[k])) slot.side = 0;
      limits_[i] = slot.limits();
    }
    return !watch_->fired.empty();
  }

  static constexpr double never = std::numeric_limits<double>::infinity();

  Machine* machine_;
  Watch* watch_;
  std::vector<double> x_, low_, high_, middle_;
  std::vector<double> at_root_, before_;
  std::vector<double> noise_;    // of guards about their root: interpolants waver by a rounding
  std::vector<double> earlier_;  // guards at the look before the last
  double earlier_at_ = never;    // its offset, below zero if it was in the step before
  std::vector<std::size_t> crossed_;
  std::vector<std::pair<double, double>> limits_;  // of the active slots
  double t0_ = 0.0, root_ = 0.0;
};

}  // namespace saltus
