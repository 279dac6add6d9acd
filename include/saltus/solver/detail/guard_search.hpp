// Guard search: the earliest crossing of the guards that are located together inside one solver step, on the
// solver's own interpolant.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/found_root.hpp"
#include "saltus/solver/detail/look_pace.hpp"
#include "saltus/solver/detail/look_points.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Looks at the guards that are located together at a few interior points of a step. It also looks where three
/// looks suggest that a guard dips across zero and back (a pair of roots). The first interval in
/// which a guard crosses is narrowed.
class GuardSearch : private FoundRoot {
 public:
  GuardSearch(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : FoundRoot(machine, guards, located) {
    for (auto* values :
         {&at_root_, &before_, &end_, &at_end_, &begin_.last, &begin_.earlier, &begin_.oldest})
      values->assign(machine.plan().guard_slots, 1.0);
  }

  bool has_guards() const noexcept { return !located_->slots.empty(); }

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
    points_ =
        part.points == nullptr ? nullptr : part.points->between(*located_, part.from, part.to);
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
  /// all active guards are located together, and a look inside is not due. `end` is the state at
  /// its end. False if that look does not exclude a crossing: `find` goes on from there.
  [[gnu::always_inline]] bool passes(double t0, double length, const double* end) {
    if (skipped_ >= patience_ || outdated() || !passes_) return false;
    machine_->guards(t0 + length, end, high_.data());
    if (!out_of_reach(length)) {
      looked_ = true;
      return false;
    }
    ++skipped_;
    earlier_at_ -= length;  // offsets are those of the next step from here on
    shift_all(-length, 0.0);
    return true;
  }

  /// The step ends here: offsets are relative to the next one from now on.
  void end_step(double length) { earlier_at_ -= length, oldest_at_ -= length; }

  void begin_run() { forget(), pace_.begin_run(); }
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
    choose_patience(needless);
    end_.swap(high_);
    end_at_ = part.to;
    double from = part.from;
    const int pieces = 1 + (points_ == nullptr ? scan_points_ : static_cast<int>(points_->size()));
    const double length = (part.to - from) / pieces;
    double next = from;
    if (earlier_at_ == never && scans() && some_beyond()) {
      const double early = from + thresholds::first_look * length;
      look(early, nullptr, interpolate, high_);
      if (find_in(from, early, nullptr, interpolate)) return true;
      from = early;
    }
    begin_pieces(from, length, interpolate);
    for (int piece = 1; piece < pieces; ++piece) {
      next = points_ == nullptr ? std::min(part.to, next + length) : nth(*points_, piece - 1);
      look(next, nullptr, interpolate, high_);
      if (find_in_even(from, next, nullptr, interpolate)) return true;
      from = next;
    }
    high_.swap(end_);
    return find_in_even(from, part.to, part.end, interpolate);
  }

  template <class Interpolate>
  void begin_pieces(double from, double even, const Interpolate& interpolate) {
    const double resolution = thresholds::eps * (std::abs(t0_) + end_at_);
    refines_ = scans() && even * thresholds::finest_piece > thresholds::look_roundings * resolution;
    if (scans()) slow_down();
    if (!refines_) return;
    even_ = even;
    begin_judging();
    const bool first = pace_.begin_step(even);
    const bool verified = pace_.is_finer_than(even) && has_four_looks();
    verified_from_ = verified ? never : from;
    if (!verified) keep_looks(begin_);
    if (first) choose_pace(from, interpolate);
  }

  /// In the first step of a run no look says how fast the guards vary. Looks at three points, not
  /// evenly spaced, and compares them with the derivatives of the guards along the flow where the
  /// step begins, because a guard may have the period of the looks.
  template <class Interpolate>
  void choose_pace(double from, const Interpolate& interpolate) {
    const double near = thresholds::near_share * even_;
    look(from + near, nullptr, interpolate, before_);
    const auto is_steep = [&](std::size_t k, double piece, double range) {
      const double rate = (before_[k] - begin_.last[k]) / near;
      return std::abs(rate) * piece > thresholds::steep_ranges * range;
    };
    for (double piece = std::min(even_, (end_at_ - from) / 3.0);; piece *= 0.5) {
      oldest_ = begin_.last, oldest_at_ = from;
      earlier_at_ = from + piece;
      look(earlier_at_, nullptr, interpolate, earlier_);
      const double third = from + thresholds::uneven * piece, last = from + 3.0 * piece;
      look(third, nullptr, interpolate, middle_);
      look(last, nullptr, interpolate, high_);
      guards_->g = middle_;
      const bool hidden = any_varies(third, last, [&](std::size_t k, const Variation& each) {
        return each.hides() || is_steep(k, piece, each.range);
      });
      set_looks(begin_);
      if (!hidden || !pace_.halve(piece, even_)) return;
    }
  }

  /// `find_in_piece`, in shorter pieces where a guard varies too fast for one.
  template <class Interpolate>
  bool find_in_even(double from, double to, const double* end, const Interpolate& interpolate) {
    const bool finer = pace_.is_finer_than(to - from);
    if (!refines_ || !(finer || hides(from, to))) return find_in_piece(from, to, end, interpolate);
    at_end_ = high_;
    if (!finer && pace_.halve(to - from, even_)) go_back(from);
    while (from < to) {
      const double next = std::min(to, from + pace_.next(to - from));
      if (next == to)
        high_ = at_end_;
      else
        look(next, nullptr, interpolate, high_);
      const bool hidden = hides(from, next);
      if (hidden && pace_.halve(next - from, even_)) {
        go_back(from);
        continue;
      }
      if (hidden) note_in_vain(from, next);
      if (has_four_looks()) verified_from_ = never;
      if (!hidden) pace_.accept(next - from, has_four_looks() && is_slow(from, next));
      if (find_in_piece(from, next, next == to ? end : nullptr, interpolate)) return true;
      from = next;
    }
    return false;
  }

  /// The pieces before may have been too long, too: those that nothing has verified, and in which
  /// no record has changed, are searched again.
  void go_back(double& from) {
    if (verified_from_ == never || from == verified_from_) return;
    set_looks(begin_);
    from = verified_from_;
  }

  /// If the look was not needed, the next one comes later: after 7 steps, 15, 31, then 63.
  void choose_patience(bool needless) {
    patience_ = needless && skipped_ > 0 ? std::min(2 * patience_ + 1, thresholds::most_patience)
                                         : thresholds::least_patience;
    skipped_ = 0;
  }

  /// `find_in`, unless the looks at both ends show that nothing happens in between.
  template <class Interpolate>
  bool find_in_piece(double from, double to, const double* end, const Interpolate& interpolate,
                     bool between = true) {
    if (!nothing_fired(from, to)) {
      verified_from_ = never;
      return from < to && find_in(from, to, end, interpolate, between);
    }
    shift_all(from, to, 1.0);
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
      if (high == to && crossed_.size() >= thresholds::crowd_size) {
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
      if (locate(from, high, to, interpolate, between)) return true;
      leave_zero_of_monitors(from, to, interpolate);
    }
    return false;
  }

  /// Narrows the crossing in (from, high], moves `from` to it, and notes it. Returns whether the
  /// search ends there, or in the part before it.
  template <class Interpolate>
  bool locate(double& from, double high, double to, const Interpolate& interpolate, bool between) {
    const double before = from;
    before_ = guards_->g;
    third_ = end_, third_at_ = high < end_at_ ? end_at_ : never;
    from = narrow(from, high, interpolate);
    if (between && located_->slots.size() > 1 && scans()) {
      if (find_before(before, from, interpolate)) return true;
    } else if (from - before > thresholds::short_share * (to - before)) {
      set_earlier(before, before_);
    }
    from = at_root_of_step(from, interpolate);
    may_go_back_ = false;
    return take(from);
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
      if (find_in_piece(from, next, nullptr, interpolate, false)) return true;
      from = next;
    }
    high_ = at_root_;
    if (!note_crossed(high_)) crossed_.clear();  // a monitor was found one rounding before it
    return false;
  }

  /// Whether some guard with one direction is on its firing side.
  bool some_beyond() const {
    return std::ranges::any_of(located_->slots,
                               [&](std::size_t k) { return (*guards_)[k].is_beyond(); });
  }

  List<double> at_root_, before_;
  LookPace pace_;
  Looks begin_;                   // those where the search of the step began
  double verified_from_ = never;  // where that was, if it may have to go back there
  List<double> at_end_;           // guards at the end of an evenly spaced piece
  double even_ = 0.0;             // [s] between the evenly spaced looks
  bool refines_ = false;          // there may be looks between these
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
