// Timed search: whether a guard follows the time itself, so that the steps of a method, which are
// chosen for the states, say nothing of it.
#pragma once

#include <algorithm>

#include "saltus/base/detail/is_defined.hpp"
#include "saltus/solver/detail/piece_search.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/time_probe.hpp"

namespace saltus {

/// Finds out which guards follow the time: from the plan, or by a look where the plan does not know it.
class TimedSearch : protected PieceSearch {
 protected:
  TimedSearch(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : PieceSearch(machine, guards, located), before_(machine.plan().look_slots, 1.0) {}

  [[gnu::always_inline]] bool follow_time() const { return probe_.follow(located_->follow_time); }

  /// A step is looked into: whether some functions have to be asked in it.
  void begin_asking() { asks_ = located_->follow_time == FollowsTime::perhaps && probe_.is_due(); }
  bool asks() const { return asks_; }

  /// Asks whether some guard varies from `u` on while the state is kept; x_ has the state at u, and
  /// `values` the guards. A function that throws counts as following the time, because it may refuse a
  /// state that does not belong to the time.
  template <class Interpolate>
  void ask(double u, const List<double>& values, double even, const Interpolate& interpolate) {
    asks_ = false;
    const bool defined = detail::is_defined(
        [&] { look(u + thresholds::times_apart * even, x_.data(), interpolate, middle_); });
    probe_.found = !defined || std::ranges::any_of(located_->slots, [&](std::size_t k) {
      return values[k] != middle_[k] && !(*guards_)[k].jumps;
    });
  }

  TimeProbe probe_, kept_probe_;
  List<double> before_;  // guards where a search begins, or a little later

 private:
  bool asks_ = false;
};

}  // namespace saltus
