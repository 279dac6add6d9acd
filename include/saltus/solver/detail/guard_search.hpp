// Location: the earliest crossing of any guard inside one solver step, on the solver's own
// interpolant.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/solver/detail/crowd_locator.hpp"
#include "saltus/solver/detail/dip.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Looks at all guards at a few interior points of a step. It also looks where three looks suggest
/// that a guard dips across zero and back (a pair of roots). The first interval in which a guard
/// crosses is narrowed.
class Locator : private CrowdLocator {
 public:
  Locator(Machine& machine, GuardSet& guards) : CrowdLocator(machine, guards) {
    const auto slots = static_cast<std::size_t>(machine.plan().guard_slots);
    for (auto* values : {&at_root_, &before_, &end_}) values->assign(slots, 1.0);
  }

  /// Finds the first offset in (from, to] at which a guard other than a monitor fires; false if
  /// there is none. The step begins at `t0`; `interpolate(u, x)` gives the state inside it, `end`
  /// is the state at exactly `to`, `guards` are the guards there if they are known, otherwise null.
  template <class Interpolate>
  bool find(double t0, double from, double to, const double* end, const double* guards,
            const Interpolate& interpolate) {
    t0_ = t0;
    if (outdated()) look_up_guards();
    if (guards != nullptr)
      std::copy_n(guards, high_.size(), high_.data());
    else
      look(to, end, interpolate, high_);
    const bool skips = guards_->scan_points > 0 && out_of_reach(from, to);
    if (!skips || skipped_ >= patience_) return find_inside(from, to, end, skips, interpolate);
    ++skipped_;
    shift_all(from, to);
    earlier_at_ -= to;  // relative to the next step
    return false;
  }

  /// Forgets the looks before a restart, which have no meaning after it.
  void forget() {
    Glance::forget();
    skipped_ = patience_ = thresholds::least_patience;
  }

  double offset() const noexcept { return root_; }

 private:
  /// `find` with looks inside the step. It is a function of its own because most steps need only
  /// the rest of `find`. If a look throws, the guards are as before.
  template <class Interpolate>
  [[gnu::noinline]] bool find_inside(double from, double to, const double* end, bool needless,
                                     const Interpolate& interpolate) {
    guards_->keep();
    try {
      return find_in_pieces(from, to, end, needless, interpolate);
    } catch (...) {
      guards_->restore();
      throw;
    }
  }

  /// `find` piece by piece; high_ has the guards at the end of the step.
  template <class Interpolate>
  bool find_in_pieces(double from, double to, const double* end, bool needless,
                      const Interpolate& interpolate) {
    // If the look was not needed, the next one comes later: after 7 steps, 15, 31, then 63.
    patience_ = needless && skipped_ > 0 ? std::min(2 * patience_ + 1, thresholds::most_patience)
                                         : thresholds::least_patience;
    skipped_ = 0;
    end_.swap(high_);
    end_at_ = to;
    const int pieces = guards_->scan_points + 1;
    const double piece_length = (to - from) / pieces;
    double next = from;
    if (earlier_at_ == never && guards_->some_beyond && guards_->scan_points > 0) {
      const double early = from + thresholds::first_look * piece_length;
      look(early, nullptr, interpolate, high_);
      if (find_in(from, early, nullptr, interpolate)) return true;
      from = early;
    }
    for (int piece = 1; piece <= pieces; ++piece) {
      const bool last = piece == pieces;
      next = last ? to : std::min(to, next + piece_length);
      if (last)
        high_.swap(end_);
      else
        look(next, nullptr, interpolate, high_);
      if (calm(from, next))
        shift_all(from, next);
      else if (from < next && find_in(from, next, last ? end : nullptr, interpolate))
        return true;
      from = next;
    }
    earlier_at_ -= to;
    return false;
  }

  /// `find` in one piece of a step; `high_` has the guards at its end. There are no looks in
  /// between, except where a guard seems to dip across zero and back. Monitors are noted and
  /// passed.
  template <class Interpolate>
  bool find_in(double from, double to, const double* end, const Interpolate& interpolate,
               bool between = true) {
    for (bool looked = true; from < to; looked = false) {
      if (!looked) look(to, end, interpolate, high_);
      const double high = note_crossed(high_) ? to : next_dip(from, to, interpolate);
      if (high == never) continue;
      if (high == to && crossed_.size() >= crowd_size) {
        const Crowd crowd = locate_crowd(from, to, interpolate);
        if (crowd == Crowd::located) return false;
        if (crowd == Crowd::too_wide) {
          const double middle = from + 0.5 * (to - from);
          look(middle, nullptr, interpolate, high_);
          if (find_in(from, middle, nullptr, interpolate, between)) return true;
          from = middle;
          continue;
        }
      }
      const double before = from;
      before_ = guards_->g;
      // This look does not depend on the other guards, because no monitor may change a bit of a
      // root.
      third_ = end_, third_at_ = high < end_at_ ? end_at_ : never;
      from = narrow(from, high, interpolate);
      if (between && guards_->active().size() > 1 && guards_->scan_points > 0) {
        if (find_before(before, from, interpolate)) return true;
      } else if (from - before > thresholds::short_share * (to - before)) {
        earlier_.swap(before_);
        earlier_at_ = before;
      }
      if (take(from)) return true;
      leave_zero_of_monitors(from, to, interpolate);
    }
    return false;
  }

  /// No guard fired at `to`: the offset of a dip at which a guard fires. If there is none, returns
  /// `never` and moves `from` to the end of the part that was looked at.
  template <class Interpolate>
  double next_dip(double& from, double to, const Interpolate& interpolate) {
    const double dip = guards_->scan_points > 0 ? find_dip(from, to, interpolate) : never;
    if (dip != never) {
      high_.swap(middle_);
      if (note_crossed(high_)) return dip;  // otherwise it dips to its other side
    }
    shift(from);
    follow();
    from = dip;
    return never;
  }

  /// `find` in the part before a root. The root shortens the step, so the looks need new points.
  /// Afterwards `high_` and crossed_ belong to the root again.
  template <class Interpolate>
  bool find_before(double from, double root, const Interpolate& interpolate) {
    at_root_ = high_;
    const double piece = (root - from) / (guards_->scan_points + 1);
    for (int i = 1; i <= guards_->scan_points; ++i) {
      const double next = std::min(root, from + piece);
      if (from < next) look(next, nullptr, interpolate, high_);
      if (find_in(from, next, nullptr, interpolate, false)) return true;
      from = next;
    }
    high_ = at_root_;
    if (!note_crossed(high_)) crossed_.clear();  // a monitor was found one rounding before it
    return false;
  }

  /// Gives a monitor located exactly on zero its side: the sign at a point slightly later.
  template <class Interpolate>
  void leave_zero_of_monitors(double from, double to, const Interpolate& interpolate) {
    const auto unsure = [&](std::size_t k) { return (*guards_)[k].side == 0; };
    if (std::ranges::none_of(crossed_, unsure)) return;
    const double resolution = thresholds::eps * (std::abs(t0_) + from);
    look(std::min(to, from + std::max(thresholds::leave_roundings * resolution,
                                      thresholds::leave_share * (to - from))),
         nullptr, interpolate, middle_);
    for (const std::size_t k : crossed_) {
      if (unsure(k)) guards_->leave_to(k, sign_of(middle_[k]));
    }
    look_up_guards();
  }

  /// The offset between two looks at which a guard seems to cross zero and come back. It is the
  /// vertex of the parabola through three looks, moved by successive parabolic interpolation (R. P.
  /// Brent, "Algorithms for Minimization without Derivatives", 1973, ch. 5) until the guard there
  /// is beyond zero. `middle_` then has the guards at that offset; `never` if there is no such
  /// offset.
  template <class Interpolate>
  double find_dip(double from, double to, const Interpolate& interpolate) {
    if (earlier_at_ == never) return never;
    for (const std::size_t k : guards_->active()) {
      const Guard& guard = (*guards_)[k];
      if (guard.side == 0 || guard.at_zero() || guard.jumps) continue;
      Dip dip{{earlier_at_, from, to},
              {guard.side * earlier_[k], guard.side * guards_->g[k], guard.side * high_[k]}};
      // A touch within rounding is no dip; nor is a vertex far above zero.
      const double size = std::max({dip.g[0], dip.g[1], dip.g[2]});
      double u = dip.vertex(thresholds::shallow_dip * size);
      for (int round = 0; round < thresholds::dip_looks && u > from && u < to; ++round) {
        look(u, nullptr, interpolate, middle_);
        const double g = guard.side * middle_[k];
        if (g < -thresholds::dip_rounding * size) return u;
        dip.replace(u, g);
        u = dip.vertex(thresholds::slow_dip * dip.g[1]);
      }
    }
    return never;
  }

  /// Whether a guard that has a firing side, and has not crossed, is as close to zero as it moves in
  /// four brackets of the root.
  bool is_beside_root(std::size_t k) const {
    const Guard& guard = (*guards_)[k];
    return guard.phase == Phase::armed && !guard.monitor && !guard.jumps &&
           guard.has_one_direction() &&
           std::abs(high_[k]) <= thresholds::root_noise * std::abs(high_[k] - low_[k]) &&
           !guard.crossed(high_[k]);
  }

  [[noreturn]] void throw_not_finite(std::size_t k, double t) const {
    const Plan& plan = machine_->plan();
    const GuardGroup& group = plan.guards[static_cast<std::size_t>((*guards_)[k].group)];
    throw SimulationError(text("t = ", t, " s: guard '", group.name,
                               "' is not finite (NaN or Inf); check it at this state"),
                          t, plan.leaves[static_cast<std::size_t>(group.leaf)].path);
  }

  /// Moves a monitor to its other side. It is at zero until it is clearly off.
  void pass_monitor(const Firing& firing, double u) {
    const auto k = static_cast<std::size_t>(firing.slot);
    guards_->monitors.push_back({t0_ + u, firing});
    if ((*guards_)[k].direction == Direction::edge_detection) return;
    guards_->pass(k, sign_of(high_[k]), noise_[k]);
  }

  /// Notes the guards that fired at offset u; true if one of them is not a monitor.
  bool take(double u) {
    root_ = u;
    guards_->fired_at_root.clear(), guards_->beside_root.clear();
    for (const std::size_t k : crossed_) {
      const Guard& guard = (*guards_)[k];
      if (!std::isfinite(high_[k])) throw_not_finite(k, t0_ + u);
      const Firing firing{static_cast<int>(k), guard.side, guard.at_zero(), jump_[k]};
      if (guard.monitor)
        pass_monitor(firing, u);
      else
        guards_->fired_at_root.push_back(firing);
    }
    for (const std::size_t k : guards_->active()) {
      const Guard& guard = (*guards_)[k];
      guards_->g[k] = high_[k];
      if (is_beside_root(k)) guards_->beside_root.push_back(k);
      guards_->follow(k, high_[k]);
      // A guard exactly on zero takes the side to which it leaves.
      if (guard.phase != Phase::resting && guard.crossed(high_[k])) guards_->leave_to(k, 0);
    }
    const bool stops = !guards_->fired_at_root.empty();
    stops ? forget_guards() : look_up_guards();
    return stops;
  }

  std::vector<double> at_root_, before_;
  double root_ = 0.0;
  std::vector<double> end_;  // guards at the end of the step, until the look at its last piece
  double end_at_ = 0.0;
  int patience_ = thresholds::least_patience;  // allowed steps in a row without a look inside
  int skipped_ = thresholds::least_patience;   // steps in a row without a look inside
};

}  // namespace saltus
