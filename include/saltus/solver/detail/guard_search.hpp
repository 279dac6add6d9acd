// Guard search: the earliest crossing of the guards of one watch inside one solver step, on the
// solver's own interpolant.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/dip_search.hpp"
#include "saltus/solver/detail/look_points.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Looks at the guards of a watch at a few interior points of a step. It also looks where three
/// looks suggest that a guard dips across zero and back (a pair of roots). The first interval in
/// which a guard crosses is narrowed.
class GuardSearch : private DipSearch {
 public:
  GuardSearch(Machine& machine, GuardSet& guards, const Watch& watch)
      : DipSearch(machine, guards, watch) {
    for (auto* values : {&at_root_, &before_, &end_})
      values->assign(machine.plan().guard_slots, 1.0);
  }

  bool has_guards() const noexcept { return !watch_->slots.empty(); }

  /// What a search is about: the step begins at `t0`, and is searched in (from, to]. `end` is the
  /// state at exactly `to` and `guards` are the guards there, if they are known; otherwise null.
  struct Part {
    double t0, from, to;
    const double *end = nullptr, *guards = nullptr;
    int scan_points;               ///< interior points with a look
    LookPoints* points = nullptr;  ///< chooses them in place of even ones, where it knows them
    bool to_root = false;          ///< the solver stops at `to`
  };

  /// Finds the first offset at which a guard other than a monitor fires; false if there is none.
  /// Monitors are noted on the way. `interpolate(u, x)` gives the state inside the step. If a look
  /// throws, GuardSet::restore restores the records.
  template <class Interpolate>
  bool find(const Part& part, const Interpolate& interpolate) {
    points_ = part.points == nullptr ? nullptr : part.points->between(*watch_, part.from, part.to);
    t0_ = part.t0, to_root_ = part.to_root;
    scan_points_ = points_ == nullptr ? part.scan_points : 0;
    few_.clear(), may_go_back_ = false;
    if (outdated()) look_up_guards();
    if (part.guards != nullptr)
      std::copy_n(part.guards, high_.size(), high_.data());
    else if (!std::exchange(looked_, false))
      look(part.to, part.end, interpolate, high_);
    passes_ = scans() && part.points == nullptr;
    const bool skips = scans() && out_of_reach(part.to - part.from);
    if (!skips || skipped_ >= patience_) return find_inside(part, skips, interpolate);
    ++skipped_;
    shift_all(part.from, part.to);
    return false;
  }

  /// `find` and `end_step` for a whole step in which no guard fires, in a short form for most steps:
  /// all active guards are of this watch, and a look inside is not due. `end` is the state at
  /// its end. False if that look does not exclude a crossing: `find` goes on from there.
  [[gnu::always_inline]] bool passes(double t0, double length, const double* end) {
    if (skipped_ >= patience_ || outdated() || !passes_) return false;
    machine_->guards(t0 + length, end, high_.data());
    if (!out_of_reach(length)) {
      looked_ = true;
      return false;
    }
    ++skipped_;
    shift_all(-length, 0.0);
    return true;
  }

  /// The step ends here: offsets are relative to the next one from now on.
  void end_step(double length) { earlier_at_ -= length; }

  /// Forgets the looks before a restart, which have no meaning after it.
  void forget() {
    Glance::forget();
    skipped_ = patience_ = thresholds::least_patience;
  }

  double offset() const noexcept { return root_; }

 private:
  /// `find` piece by piece; high_ has the guards at the end. It is a function of its own because
  /// most steps need only the rest of `find`.
  template <class Interpolate>
  [[gnu::noinline]] bool find_inside(const Part& part, bool needless,
                                     const Interpolate& interpolate) {
    guards_->keep();
    double from = part.from;
    const double to = part.to, *end = part.end;
    // If the look was not needed, the next one comes later: after 7 steps, 15, 31, then 63.
    patience_ = needless && skipped_ > 0 ? std::min(2 * patience_ + 1, thresholds::most_patience)
                                         : thresholds::least_patience;
    skipped_ = 0;
    end_.swap(high_);
    end_at_ = to;
    const int pieces = 1 + (points_ == nullptr ? scan_points_ : static_cast<int>(points_->size()));
    const double piece_length = (to - from) / pieces;
    double next = from;
    if (earlier_at_ == never && scans() && some_beyond()) {
      const double early = from + thresholds::first_look * piece_length;
      look(early, nullptr, interpolate, high_);
      if (find_in(from, early, nullptr, interpolate)) return true;
      from = early;
    }
    for (int piece = 1; piece <= pieces; ++piece) {
      const bool last = piece == pieces;
      next = last                 ? to
             : points_ == nullptr ? std::min(to, next + piece_length)
                                  : nth(*points_, piece - 1);
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
      third_ = end_, third_at_ = high < end_at_ ? end_at_ : never;
      from = narrow(from, high, interpolate);
      if (between && watch_->slots.size() > 1 && scans()) {
        if (find_before(before, from, interpolate)) return true;
      } else if (from - before > thresholds::short_share * (to - before)) {
        earlier_.swap(before_);
        earlier_at_ = before;
      }
      from = at_root_of_step(from, interpolate);
      may_go_back_ = false;
      if (take(from)) return true;
      leave_zero_of_monitors(from, to, interpolate);
    }
    return false;
  }

  /// A monitor that crosses within the bracket of the root at which the solver stops crosses there:
  /// equal guards fire at equal times.
  template <class Interpolate>
  double at_root_of_step(double u, const Interpolate& interpolate) {
    const double bracket = thresholds::bracket_roundings * thresholds::eps * end_at_;
    if (!to_root_ || u == end_at_ || end_at_ - u > bracket) return u;
    look(end_at_, nullptr, interpolate, high_);
    note_crossed(high_);
    return end_at_;
  }

  /// `find` in the part before a root. The root shortens the step, so the looks need new points.
  /// Afterwards `high_` and crossed_ belong to the root again.
  template <class Interpolate>
  bool find_before(double from, double root, const Interpolate& interpolate) {
    at_root_ = high_;
    const double piece = (root - from) / (scan_points_ + 1);
    for (int i = 1; i <= scan_points_; ++i) {
      const double next = std::min(root, from + piece);
      if (!(from < next)) break;
      look(next, nullptr, interpolate, high_);
      if (calm(from, next))
        shift_all(from, next);
      else if (find_in(from, next, nullptr, interpolate, false))
        return true;
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

  /// Whether some guard with one direction is on its firing side.
  bool some_beyond() const {
    return std::ranges::any_of(watch_->slots,
                               [&](std::size_t k) { return (*guards_)[k].is_beyond(); });
  }

  /// Whether a guard that has a firing side, and has not crossed, is as close to zero as it moves
  /// in four brackets of the root.
  bool is_beside_root(std::size_t k) const {
    const Guard& guard = (*guards_)[k];
    return guard.phase == Phase::armed && !guard.monitor && !guard.jumps &&
           guard.has_one_direction() &&
           std::abs(high_[k]) <= thresholds::root_noise * std::abs(high_[k] - low_[k]) &&
           !guard.crossed(high_[k]);
  }

  [[noreturn]] void throw_not_finite(std::size_t k, double t) const {
    const Plan& plan = machine_->plan();
    const GuardGroup& group = plan.guards[(*guards_)[k].group];
    throw SimulationError(text("t = ", t, " s: guard '", group.name,
                               "' is not finite (NaN or Inf); check it at this state"),
                          t, plan.leaves[group.leaf].path);
  }

  /// Moves a monitor to its other side. It is at zero until it is clearly off.
  void pass_monitor(const Firing& firing, double u) {
    const std::size_t k = firing.guard();
    guards_->monitors.push_back({t0_ + u, firing});
    if ((*guards_)[k].direction == Direction::edge_detection) return;
    guards_->pass(k, sign_of(high_[k]), noise_[k]);
  }

  /// Notes the guards that fired at offset u; true if one of them is not a monitor.
  bool take(double u) {
    root_ = u;
    bool stops = false;
    for (const std::size_t k : crossed_) {
      const Guard& guard = (*guards_)[k];
      if (!std::isfinite(high_[k])) throw_not_finite(k, t0_ + u);
      const Firing firing{static_cast<int>(k), guard.side, guard.at_zero(), jump_[k]};
      if (guard.monitor)
        pass_monitor(firing, u);
      else
        guards_->fired_at_root.push_back(firing), stops = true;
    }
    for (const std::size_t k : watch_->slots) {
      const Guard& guard = (*guards_)[k];
      guards_->g[k] = high_[k];
      if (is_beside_root(k)) guards_->beside_root.push_back(k);
      guards_->follow(k, high_[k]);
      // A guard exactly on zero takes the side to which it leaves.
      if (guard.phase != Phase::resting && guard.crossed(high_[k])) guards_->leave_to(k, 0);
    }
    stops ? forget_guards() : look_up_guards();
    return stops;
  }

  List<double> at_root_, before_;
  double root_ = 0.0;
  bool to_root_ = false;
  const std::vector<double>* points_ = nullptr;  // where to look inside; null: evenly
  List<double> end_;  // guards at the end of the step, until the look at its last piece
  double end_at_ = 0.0;
  int patience_ = thresholds::least_patience;  // allowed steps in a row without a look inside
  int skipped_ = thresholds::least_patience;   // steps in a row without a look inside
  bool passes_ = false;  // `passes` may stand for `find`: even points, and no guard that jumps
  bool looked_ =
      false;  // high_ has the guards at the end of the step that `passes` did not exclude
};

}  // namespace saltus
