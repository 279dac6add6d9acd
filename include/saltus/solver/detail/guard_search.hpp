// Guard search: the earliest crossing of the guards that are located together inside one solver
// step, on the solver's own interpolant.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/look_points.hpp"
#include "saltus/solver/detail/paced_search.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"

namespace saltus {

/// Whether a guard may be at zero at a stop, within its rounding: its value there is far below its last
/// `move`. A guard that jumps does not say how far its zero is.
inline bool is_beside_stop(const Guard& guard, double value, double move) {
  return guard.phase == Phase::armed &&
         (guard.jumps || std::abs(value) <= thresholds::beside_stop * std::abs(move));
}

/// Looks at the guards that are located together at a few interior points of a step, and searches
/// the pieces in between one after the other. A step in which no guard could come to zero is not
/// looked into, except from time to time.
class GuardSearch : private PacedSearch {
 public:
  GuardSearch(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : PacedSearch(machine, guards, located) {}

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
    look_at_end(part, interpolate);
    const bool timed = follow_time();
    if (timed && scans()) limit_pieces(part.from, part.to, interpolate);
    passes_ = scans() && part.points == nullptr && !timed;
    const double length = part.to - part.from;
    const bool skips = scans() && (!timed || shows(length)) && out_of_reach(length);
    if (!skips || skipped_ >= patience_) return find_inside(part, skips, interpolate);
    ++skipped_;
    shift_all(part.from, part.to);
    return false;
  }

  /// `find` and `end_step` for a whole step in which no guard fires, in a short form for most
  /// steps: all active guards are located together, and a look inside is not due. `end` is the
  /// state at its end. False if that look does not exclude a crossing: `find` goes on from there.
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

  /// Notes the guards that may be at zero at the end of the step, at its last look.
  void note_beside_stop() {
    for (const std::size_t k : located_->slots)
      if (is_beside_stop((*guards_)[k], guards_->g[k], guards_->g[k] - earlier_[k]))
        guards_->beside_stop.push_back(k);
  }

  using PacedSearch::keep, PacedSearch::restore;
  void begin_run() { forget(), PacedSearch::begin_run(); }
  /// Forgets the looks before a restart, which have no meaning after it.
  void forget() {
    Glance::forget();
    skipped_ = patience_ = thresholds::least_patience;
  }

  double offset() const noexcept { return root_; }

 private:
  /// Puts the guards at the end of the part into high_.
  template <class Interpolate>
  [[gnu::always_inline]] void look_at_end(const Part& part, const Interpolate& interpolate) {
    if (part.guards != nullptr)
      std::copy_n(part.guards, high_.size(), high_.data());
    else if (!std::exchange(looked_, false))
      look(part.to, part.end, interpolate, high_);
  }

  /// `find` piece by piece; high_ has the guards at the end. It is a function of its own because
  /// most steps need only the rest of `find`.
  template <class Interpolate>
  [[gnu::noinline]] bool find_inside(const Part& part, bool needless,
                                     const Interpolate& interpolate) {
    choose_patience(needless);
    end_.swap(high_);
    end_at_ = part.to;
    double from = part.from;
    const int pieces = 1 + (points_ == nullptr ? scan_points_ : static_cast<int>(points_->size()));
    const double length = (part.to - from) / pieces;
    double next = from;
    begin_pieces(from, length, interpolate);
    if (passes_) passes_ = !follow_time();  // it may have been found
    if (is_early_look_due()) {
      const double early = from + thresholds::first_look * next_piece(length);
      look(early, nullptr, interpolate, high_);
      if (find_in(from, early, nullptr, interpolate)) return true;
      from = early;
    }
    for (int piece = 1;; ++piece) {
      const bool last = piece == pieces;
      if (last) {
        next = part.to, high_.swap(end_);
      } else {
        next = points_ == nullptr ? std::min(part.to, next + length) : nth(*points_, piece - 1);
        look(next, nullptr, interpolate, high_);
      }
      if (find_in_even(from, next, last ? part.end : nullptr, interpolate)) return true;
      if (last) return false;
      from = next;
    }
  }

  /// If the look was not needed, the next one comes later: after 7 steps, 15, 31, then 63.
  void choose_patience(bool needless) {
    patience_ = needless && skipped_ > 0 ? std::min(2 * patience_ + 1, thresholds::most_patience)
                                         : thresholds::least_patience;
    skipped_ = 0;
  }

  /// Whether a guard may come back from its firing side soon after a restart.
  bool is_early_look_due() const { return earlier_at_ == never && scans() && some_beyond(); }
  /// Whether some guard with one direction is on its firing side.
  bool some_beyond() const {
    return std::ranges::any_of(located_->slots,
                               [&](std::size_t k) { return (*guards_)[k].is_beyond(); });
  }

  const std::vector<double>* points_ = nullptr;  // where to look inside; null: evenly
  int patience_ = thresholds::least_patience;    // allowed steps in a row without a look inside
  int skipped_ = thresholds::least_patience;     // steps in a row without a look inside
  bool passes_ = false;  // `passes` may stand for `find`: even points, no guard follows the time
  bool looked_ = false;  // high_ has the guards at the end of a step that `passes` did not exclude
};

}  // namespace saltus
