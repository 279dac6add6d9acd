// Piece search: the crossings of the guards in one piece of a step, between two looks.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/found_root.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Narrows the first interval of a piece in which a guard crosses. Looks in between where three
/// looks suggest that a guard dips across zero and back (a pair of roots).
class PieceSearch : protected FoundRoot {
 protected:
  PieceSearch(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : FoundRoot(machine, guards, located) {
    for (auto* values : {&at_root_, &end_}) values->assign(machine.plan().look_slots, 1.0);
  }

  /// `find_in`, unless the looks at both ends show that nothing happens in between.
  template <class Interpolate>
  [[gnu::always_inline]] bool find_in_piece(double from, double to, const double* end,
                                            const Interpolate& interpolate, bool between = true) {
    if (!nothing_fired(from, to)) {
      records_may_differ_ = true;
      return from < to && find_in(from, to, end, interpolate, between);
    }
    shift_all(from, to, 1.0);
    return false;
  }

  /// `find` in one piece of a step; `high_` has the guards at its end. There are no looks in
  /// between, except where a guard seems to dip across zero and back. Monitors are noted and
  /// passed.
  template <class Interpolate>
  [[gnu::noinline]] bool find_in(double from, double to, const double* end,
                                 const Interpolate& interpolate, bool between = true) {
    guards_->keep();
    for (bool looked = true; from < to; looked = false) {
      if (!looked) look(to, end, interpolate, high_);
      const double high = note_crossed(high_) ? first_crossed(from, to, interpolate)
                                              : next_dip(from, to, interpolate);
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

  List<double> end_;  // guards at the end of the step, until the look at its last piece
  bool to_root_ = false;
  bool records_may_differ_ = false;  // from those where the pieces of the step began

 private:
  /// Narrows the crossing in (from, high], moves `from` to it, and notes it. Returns whether the
  /// search ends there, or in the part before it.
  template <class Interpolate>
  bool locate(double& from, double high, double to, const Interpolate& interpolate, bool between) {
    const double before = from;
    third_at_ = high < end_at_ ? end_at_ : never;
    if (third_at_ != never) copy_values(end_, third_);
    const Bracket root = narrow(from, high, interpolate);
    from = root.high;
    if (between && located_->slots.size() > 1 && scans()) {
      if (find_before(before, root, interpolate)) return true;
    } else if (from - before > thresholds::short_share * (to - before)) {
      set_earlier(before, guards_->g);
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
  bool find_before(double from, const Bracket& root, const Interpolate& interpolate) {
    copy_values(high_, at_root_);
    const double piece = (root.high - from) / (scan_points_ + 1);
    const std::size_t noted = guards_->monitors.size();
    for (int i = 1; i <= scan_points_; ++i) {
      const double next = std::min(root.high, from + piece);
      if (!(from < next)) break;
      if (find_to(next, from, interpolate)) return true;
    }
    copy_values(at_root_, high_);
    if (from < root.low && may_cross_before(from, root.high, noted, interpolate)) {
      if (find_to(root.low, from, interpolate)) return true;
      copy_values(at_root_, high_);
    }
    if (!note_crossed(high_)) crossed_.clear();  // a monitor was found one rounding before it
    return false;
  }

  /// Searches (from, next], and moves `from` to `next`.
  template <class Interpolate>
  bool find_to(double next, double& from, const Interpolate& interpolate) {
    look(next, nullptr, interpolate, high_);
    return find_in_piece(std::exchange(from, next), next, nullptr, interpolate, false);
  }

  /// Whether something may happen in the last piece before a root, to which `high_` belongs. The root was
  /// narrowed for the sides where its part begins: a monitor that has crossed since, when there were `noted`
  /// crossings, may cross back; and a guard may dip.
  template <class Interpolate>
  bool may_cross_before(double from, double root, std::size_t noted,
                        const Interpolate& interpolate) {
    return guards_->monitors.size() > noted || find_dip(from, root, never, interpolate) != never;
  }

  List<double> at_root_;
};

}  // namespace saltus
