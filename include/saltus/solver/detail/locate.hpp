// Location: the earliest crossing of any guard inside one solver step, on the solver's own
// interpolant.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/solver/detail/dip.hpp"
#include "saltus/solver/detail/glance.hpp"

namespace saltus {

/// Looks at all guards at a few interior points of a step, and where three looks say that a guard
/// dips across zero and back (pairs of roots); the first interval in which one crosses is narrowed.
class Locator : private Glance {
 public:
  Locator(Machine& machine, GuardSet& guards) : Glance(machine, guards) {
    const auto slots = static_cast<std::size_t>(machine.plan().guard_slots);
    for (auto* values : {&at_root_, &before_, &end_}) values->assign(slots, 1.0);
  }

  /// The first offset in (from, to] at which a guard that is no monitor fires; false if there is
  /// none. The step begins at `t0`; `interpolate(u, x)` gives the state inside it, `end` is the
  /// state at `to` exactly, `guards` are the guards there if they are known, else null.
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
    earlier_at_ -= to;  // seen from the next step
    return false;
  }

  /// Begins anew: what was seen of the guards before a restart says nothing.
  void forget() {
    Glance::forget();
    skipped_ = patience_ = least_patience;
  }

  double offset() const noexcept { return root_; }

 private:
  /// The same by looks inside the step, piece by piece; high_ is known at its end. Kept out of
  /// find, which most steps go through and no further.
  template <class Interpolate>
  [[gnu::noinline]] bool find_inside(double from, double to, const double* end, bool needless,
                                     const Interpolate& interpolate) {
    // A look that was not needed may come later the next time: after 7 steps, 15, 31, then 63.
    patience_ = needless && skipped_ > 0 ? std::min(2 * patience_ + 1, 63) : least_patience;
    skipped_ = 0;
    end_.swap(high_);
    end_at_ = to;
    const int pieces = guards_->scan_points + 1;
    const double piece_length = (to - from) / pieces;
    for (int piece = 1; piece <= pieces; ++piece) {
      const bool last = piece == pieces;
      const double next = last ? to : std::min(to, from + piece_length);
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

  /// One piece of a step, `high_` looked at at its end, without points in between, save where a
  /// guard seems to dip across zero and back; monitors are noted and passed.
  template <class Interpolate>
  bool find_in(double from, double to, const double* end, const Interpolate& interpolate,
               bool between = true) {
    for (bool looked = true; from < to; looked = false) {
      if (!looked) look(to, end, interpolate, high_);
      const double high = note_crossed(high_) ? to : next_dip(from, to, interpolate);
      if (high == never) continue;
      const double before = from;
      before_ = guards_->g;
      // A look that does not depend on the other guards: no monitor may change a bit of a root.
      third_ = end_, third_at_ = high < end_at_ ? end_at_ : never;
      from = narrow(from, high, interpolate);
      if (between && guards_->active().size() > 1 && guards_->scan_points > 0) {
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

  /// Where nothing fired at `to`: the offset of a dip at which a guard does; `never` if there is
  /// none, and `from` is moved past what was looked at.
  template <class Interpolate>
  double next_dip(double& from, double to, const Interpolate& interpolate) {
    const double dip = guards_->scan_points > 0 ? find_dip(from, to, interpolate) : never;
    if (dip != never) {
      high_.swap(middle_);
      if (note_crossed(high_)) return dip;  // else it dips to the side on which it does not fire
    }
    shift(from);
    follow();
    from = dip;
    return never;
  }

  /// The same for what lies before a root: it cuts the step, and what was looked at were points of
  /// the longer one. Afterwards `high_` and crossed_ are those of the root again.
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
    if (!note_crossed(high_)) crossed_.clear();  // a monitor that was found a rounding before it
    return false;
  }

  /// A monitor located exactly on zero: the side it leaves to, a hair further on.
  template <class Interpolate>
  void leave_zero_of_monitors(double from, double to, const Interpolate& interpolate) {
    const auto unsure = [&](std::size_t k) { return (*guards_)[k].side == 0; };
    if (std::ranges::none_of(crossed_, unsure)) return;
    const double resolution = std::numeric_limits<double>::epsilon() * (std::abs(t0_) + from);
    look(std::min(to, from + std::max(64.0 * resolution, 1e-9 * (to - from))), nullptr, interpolate,
         middle_);
    for (const std::size_t k : crossed_) {
      if (unsure(k)) guards_->leave_to(k, sign_of(middle_[k]));
    }
    look_up_guards();
  }

  /// Where between two looks a guard seems to cross zero and come back: the vertex of the parabola
  /// through three looks, moved by successive parabolic interpolation (R. P. Brent, "Algorithms for
  /// Minimization without Derivatives", 1973, ch. 5) until the guard there is beyond zero.
  /// `middle_` then holds the guards at that offset; `never` if there is no such place.
  template <class Interpolate>
  double find_dip(double from, double to, const Interpolate& interpolate) {
    if (earlier_at_ == never) return never;
    for (const std::size_t k : guards_->active()) {
      const Guard& guard = (*guards_)[k];
      if (guard.side == 0 || guard.at_zero() || guard.jumps) continue;
      Dip dip{{earlier_at_, from, to},
              {guard.side * earlier_[k], guard.side * guards_->g[k], guard.side * high_[k]}};
      // A touch within rounding is none; nor is a vertex far above zero.
      const double size = std::max({dip.g[0], dip.g[1], dip.g[2]});
      double u = dip.vertex(0.25 * size);
      for (int round = 0; round < 6 && u > from && u < to; ++round) {
        look(u, nullptr, interpolate, middle_);
        const double g = guard.side * middle_[k];
        if (g < -1e-12 * size) return u;
        dip.replace(u, g);
        u = dip.vertex(0.5 * dip.g[1]);
      }
    }
    return never;
  }

  [[noreturn]] void throw_not_finite(std::size_t k, double t) const {
    const Plan& plan = machine_->plan();
    const GuardGroup& group = plan.guards[static_cast<std::size_t>((*guards_)[k].group)];
    throw SimulationError(text("t = ", t, " s: guard '", group.name,
                               "' is not finite (NaN or Inf); check it at this state"),
                          t, plan.leaves[static_cast<std::size_t>(group.leaf)].path);
  }

  /// A monitor goes over to the other side, and is at zero until it is clearly off.
  void pass_monitor(const Firing& firing, double u) {
    const auto k = static_cast<std::size_t>(firing.slot);
    guards_->monitors.push_back({t0_ + u, firing});
    if ((*guards_)[k].direction == Direction::edge_detection) return;
    guards_->pass(k, sign_of(high_[k]), noise_[k]);
  }

  /// Notes what fired at offset u; true if one of them is no monitor.
  bool take(double u) {
    root_ = u;
    guards_->fired_at_root.clear();
    for (const std::size_t k : crossed_) {
      const Guard& guard = (*guards_)[k];
      if (!std::isfinite(high_[k])) throw_not_finite(k, t0_ + u);
      const Firing firing{static_cast<int>(k), guard.side, guard.at_zero()};
      if (guard.monitor)
        pass_monitor(firing, u);
      else
        guards_->fired_at_root.push_back(firing);
    }
    for (const std::size_t k : guards_->active()) {
      const Guard& guard = (*guards_)[k];
      guards_->g[k] = high_[k];
      guards_->follow(k, high_[k]);
      // Exactly on zero it takes the side it leaves to.
      if (guard.phase != Phase::resting && guard.crossed(high_[k])) guards_->leave_to(k, 0);
    }
    const bool stops = !guards_->fired_at_root.empty();
    stops ? forget_guards() : look_up_guards();
    return stops;
  }

  static constexpr int least_patience = 7;

  std::vector<double> at_root_, before_;
  double root_ = 0.0;
  std::vector<double> end_;  // guards at the end of the step, until its last piece is looked at
  double end_at_ = 0.0;
  int patience_ = least_patience;  // how many steps in a row may go without a look inside
  int skipped_ = least_patience;   // how many did
};

}  // namespace saltus
