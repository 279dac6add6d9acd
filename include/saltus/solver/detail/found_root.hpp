// Found root: what a crossing that was located changes in the records of the guards.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/solver/detail/dip_search.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Notes the guards that crossed at an offset. A monitor changes its side there, and the search
/// continues; any other guard ends it.
class FoundRoot : protected DipSearch {
 protected:
  using DipSearch::DipSearch;

  /// Notes the guards that fired at offset u; true if one of them is not a monitor.
  bool take(double u) {
    root_ = u;
    bool stops = false;
    for (const std::size_t k : crossed_) {
      const Guard& guard = (*guards_)[k];
      if (!std::isfinite(high_[k])) throw_not_finite(k, t0_ + u);
      if (guard.direction == Direction::edge_detection) note_edge(k, u);
      const Firing firing{static_cast<int>(k), guard.side, guard.at_zero(), jump_[k]};
      if (guard.monitor)
        pass_monitor(firing, u);
      else
        guards_->fired_at_root.push_back(firing), stops = true;
    }
    for (const std::size_t k : located_->slots) {
      const Guard& guard = (*guards_)[k];
      guards_->g[k] = high_[k];
      if (is_beside_root(k)) guards_->beside_root.push_back(k);
      if (guard.stays(high_[k])) {
        guards_->follow_base(k, high_[k]);
        continue;
      }
      guards_->follow(k, high_[k]);
      // A guard exactly on zero takes the side to which it leaves.
      if (guard.phase != Phase::resting && guard.crossed(high_[k])) guards_->leave_to(k, 0);
    }
    follow_reads();
    stops ? forget_guards() : look_up_guards();
    return stops;
  }

  /// Gives a monitor located exactly on zero its side: the sign at a point slightly later, where it
  /// is beyond the rounding that its last bracket showed.
  template <class Interpolate>
  void leave_zero_of_monitors(double from, double to, const Interpolate& interpolate) {
    const auto unsure = [&](std::size_t k) { return (*guards_)[k].side == 0; };
    if (std::ranges::none_of(crossed_, unsure)) return;
    const auto rounded = [&](std::size_t k) {
      return unsure(k) && std::abs(middle_[k]) <= noise_[k];
    };
    const double resolution = thresholds::eps * (std::abs(t0_) + from);
    double later =
        std::max(thresholds::leave_roundings * resolution, thresholds::leave_share * (to - from));
    for (;; later *= thresholds::leave_growth) {
      const double at = std::min(to, from + later);
      look(at, nullptr, interpolate, middle_);
      if (!(at < to) || std::ranges::none_of(crossed_, rounded)) break;
    }
    for (const std::size_t k : crossed_) {
      if (unsure(k)) guards_->leave_to(k, sign_of(middle_[k]));
    }
    look_up_guards();
  }

  double root_ = 0.0;  // the offset of the last root

 private:
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

  /// The search of a monitor whose value varies all the time would not come to an end.
  void note_edge(std::size_t k, double u) {
    const double now = high_[k], before = (*guards_)[k].base;
    const EdgeSeries::Firing firing{t0_ + u, end_at_, std::abs(now - before),
                                    std::max(std::abs(now), std::abs(before))};
    if (guards_->edge(k, firing)) throw_endless(k, t0_ + u);
  }

  [[noreturn]] void throw_endless(std::size_t k, double t) const {
    const Plan& plan = machine_->plan();
    const GuardGroup& group = plan.guards[(*guards_)[k].group];
    const std::string& block = plan.leaves[group.leaf].path;
    const EdgeSeries& edges = (*guards_)[k].edges;
    throw ChatteringError(
        text("t = ", t, " s: guard '", group.name, "' fired ", edges.count, " times in ",
             t - edges.since,
             " s: its direction is edge_detection, which fires at each change of its value, and "
             "this "
             "value varies all the time. edge_detection is for truths and held signals; give the "
             "guard the direction crosses_zero, positive_then_non_positive or "
             "negative_then_non_negative, or let it return a truth"),
        t, block);
  }

  /// Moves a monitor to its other side. It is at zero until it is clearly off.
  void pass_monitor(const Firing& firing, double u) {
    const std::size_t k = firing.guard();
    guards_->monitors.push_back({t0_ + u, firing});
    if ((*guards_)[k].direction == Direction::edge_detection) return;
    guards_->pass(k, sign_of(high_[k]), noise_[k]);
  }
};

}  // namespace saltus
