// Timed search: whether a guard follows the time itself, so that the steps of a method, which are
// chosen for the states, say nothing of it.
#pragma once

#include <algorithm>
#include <limits>

#include "saltus/base/detail/is_defined.hpp"
#include "saltus/solver/detail/line_states.hpp"
#include "saltus/solver/detail/piece_search.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/time_probe.hpp"
#include "saltus/solver/detail/wave_looks.hpp"

namespace saltus {

/// Finds out which guards follow the time: from the plan, or by a look where the plan does not know it.
class TimedSearch : protected PieceSearch {
 protected:
  TimedSearch(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : PieceSearch(machine, guards, located),
        waves_(machine),
        before_(machine.plan().look_slots, 1.0),
        after_(machine.plan().look_slots, 1.0) {}

  [[gnu::always_inline]] bool follow_time() const { return probe_.follow(located_->follow_time); }

  /// [s] How far apart the looks between two offsets may be, by the known periods of the guards.
  template <class Interpolate>
  double longest_piece(double from, double to, const Interpolate& interpolate) {
    if (located_->follow_time != FollowsTime::yes || !waves_.any())
      return std::numeric_limits<double>::infinity();
    const bool monitors = (*guards_)[located_->slots.front()].monitor;
    return waves_.longest(*guards_, {t0_ + from, t0_ + to, monitors},
                          [&](double t, double* x) { interpolate(t - t0_, x); });
  }

  /// A step is looked into: whether some functions have to be asked in it.
  void begin_asking() { asks_ = located_->follow_time == FollowsTime::perhaps && probe_.is_due(); }
  bool asks() const { return asks_; }

  /// Asks whether some guard varies from `u` on while the state is kept, or bends while states move that the
  /// time could stand for. x_ has the state at u, and `values` the guards. A function that throws counts as
  /// following the time, because it may refuse a state that does not belong to the time.
  template <class Interpolate>
  void ask(double u, const List<double>& values, double even, const Interpolate& interpolate) {
    asks_ = false;
    const bool defined = detail::is_defined([&] {
      probe_.found = varies_in_time(u, values, even, interpolate) ||
                     bends_on_lines(u, values, even, interpolate);
    });
    if (!defined) probe_.found = true;
  }

  TimeProbe probe_, kept_probe_;
  WaveLooks waves_;
  List<double> before_;  // guards where a search begins, or a little later

 private:
  template <class Interpolate>
  bool varies_in_time(double u, const List<double>& values, double even,
                      const Interpolate& interpolate) {
    look(u + thresholds::times_apart * even, x_.data(), interpolate, middle_);
    return std::ranges::any_of(located_->slots, [&](std::size_t k) {
      return values[k] != middle_[k] && !(*guards_)[k].jumps;
    });
  }

  /// A state that moves on a straight line is a time to a guard that reads it: the method follows it by
  /// steps of any length. Where these states alone move, a guard that is no line is one of such a time.
  template <class Interpolate>
  bool bends_on_lines(double u, const List<double>& values, double even,
                      const Interpolate& interpolate) {
    const double far = even, near = thresholds::line_share * even;
    if (!lines_.find(x_, u, near, far, interpolate)) return false;
    look(u, lines_.at(0), interpolate, middle_);
    look(u, lines_.at(1), interpolate, after_);
    return std::ranges::any_of(located_->slots, [&](std::size_t k) {
      return !(*guards_)[k].jumps && lines_.bends(values[k], middle_[k], after_[k]);
    });
  }

  LineStates lines_;
  List<double> after_;
  bool asks_ = false;
};

}  // namespace saltus
