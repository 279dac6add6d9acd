// Departure: to which side of zero the flow takes a guard that is at zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>

#include "saltus/simulation/detail/first_time.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// Follows the flow from (t, x) for a short time d, to second order, and to fourth if second order
/// shows nothing. d grows until the guard has left zero by more than its rounding: that is its side.
/// A guard that stays within its rounding has no side.
class Departure : public FirstTime {
 public:
  Departure(Machine& machine, const SimulatorOptions& options)
      : FirstTime(machine, options), longest_step_(options.max_minor_step_size) {}

  /// The side to which the flow takes a guard (0: none), the rounding bound used to decide it, and the time [s]
  /// after which the guard shows its side.
  struct Side {
    int side = 0;
    double rounding = 0.0;
    double after = 0.0;
  };

  /// Sets the point to depart from; `longest` [s] bounds how far ahead it looks.
  void from(double t, const Eigen::VectorXd& x, double longest) {
    start(t, x);
    longest_ = longest;  // a run of no length has sides too
    using namespace thresholds;
    if (longest < short_run)
      longest_ = std::max(longest, std::min(short_run, short_run_looks * quickest()));
    longest_ = std::min(longest_, longest_step_);  // the author knows of something as quick
  }

  using FlowProbe::guard_after;

  /// Error of a guard at the point of departure if the states are wrong by thirty tolerances.
  double tolerance(Index slot) {
    using namespace thresholds;
    if (rtol_.by_state() || atol_.by_state())
      return lift_off_tolerances * moved_by_tolerances(slot);
    return lift_off_tolerances * (rounding(slot) * rtol_ / (state_roundings * eps) + atol_);
  }

  /// The side of a guard. A guard within `error` is at zero too, and is followed until it has left
  /// `error` as well. `expected` is a side that has the same consequence as being at zero, so that
  /// its rounding need not be measured; `either_side` if only the side matters.
  static constexpr int either_side = 2;
  Side of(const GuardGroup& group, Index slot, double error, int expected) {
    const Side side = follow(group, slot, error, expected);
    if (side.side != 0 || group.kind == GuardGroup::Kind::opaque) return side;
    fine_ = true;  // a chain of more than two integrators shows at higher order only
    const Side finer = follow(group, slot, error, expected);
    fine_ = false;
    return finer;
  }

  /// d g / d t along the flow at (t, x), by two forward differences over the first time that `of`
  /// uses. Extrapolation removes the curvature, because the curvature of a ball at rest is no
  /// speed. A result within rounding counts as zero.
  double slope(const GuardGroup& group, Index slot) {
    const double d = first_time(group, slot);
    const double near = (guard_after(0.5 * d, slot) - g0(slot)) / (0.5 * d);
    const double g = guard_after(d, slot), far = (g - g0(slot)) / d,
                 extrapolated = 2.0 * near - far;
    const double noise = std::max(thresholds::slope_noise * std::abs(far - near),
                                  4.0 * rounding_after(d, slot, g) / d);
    return std::abs(extrapolated) > noise ? extrapolated : 0.0;
  }

  /// Whether the slope is that of the guard, and not of the rounding of its values, which is larger
  /// than what the states and the time explain where the terms of a guard cancel: the slope over half
  /// of the time agrees with it, and it is far above the fourth difference, which a smooth guard does
  /// not have, and above the common measure of the values. Values that are a few roundings of the
  /// terms have one, a rounding; those of a smooth guard at times without one have none.
  bool is_slope_sure(const GuardGroup& group, Index slot) {
    const double d = first_time(group, slot), g0 = this->g0(slot);
    const double g1 = guard_after(0.25 * d, slot), g2 = guard_after(0.5 * d, slot),
                 g3 = guard_after(0.75 * d, slot), g4 = guard_after(d, slot);
    const double whole = 4.0 * (g2 - g0) - (g4 - g0), half = 8.0 * (g1 - g0) - 2.0 * (g2 - g0);
    const double noise = std::max(std::abs(g0 - 4.0 * g1 + 6.0 * g2 - 4.0 * g3 + g4),
                                  common_measure({g1, g2, g3, g4, guard_after(0.41421 * d, slot),
                                                  guard_after(0.61803 * d, slot)}));
    return whole * half > 0.0 &&
           std::abs(half - whole) < thresholds::slope_agrees * std::abs(whole) &&
           std::abs(whole) > thresholds::above_noise * noise;
  }

  /// A bound of |d g / d t| along the flow over at most `longest` [s], its rounding included.
  double speed(const GuardGroup& group, Index slot, double longest) {
    const double d = std::min(longest, thresholds::speed_looks * first_time(group, slot));
    return std::abs(guard_after(d, slot) - g0(slot)) / d;
  }

  /// d g / d t along another flow f through (t, x), to first order.
  double slope_along(const Eigen::VectorXd& f, const GuardGroup& group, Index slot) {
    const double d = first_time(group, slot);
    forget_looks();
    x1_ = *x_ + d * f;
    look(t_ + d, x1_, slot, g_);
    return (g_[slot] - g0(slot)) / d;
  }

  /// Whether these states move together: each by itself moves the guard, and all of them do not. Two
  /// bodies that fly on in contact do so; a block on a surface that other states or the time move does
  /// not.
  bool moves_together(const GuardGroup& group, Index slot, std::span<const Index> states) {
    const double d = first_time(group, slot), before = g0(slot);
    const double rounding = rounding_after(d, slot, guard_after(d, slot));
    forget_looks();
    const auto moved_by = [&](std::span<const Index> some) {
      x1_ = *x_;
      for (const Index i : some) x1_[i] += d * f_[i];
      look(t_, x1_, slot, g_);
      return std::abs(g_[slot] - before);
    };
    if (moved_by(states) > rounding) return false;
    for (std::size_t i = 0; i < states.size(); ++i)
      if (moved_by(states.subspan(i, 1)) > rounding) return true;
    return false;
  }

  /// Whether the states are at the jump of a guard, whose value does not say so, and leave it as from
  /// rest. The guard came from the side `from`, with the flow `approach`. The distance from the jump
  /// is measured by the time for which going back along `approach` shows the guard before its jump.
  /// At the jump that is the resolution of the time. From rest it grows as the square of the time
  /// since, or faster, and is a small share of it; after a passage it grows in proportion. A guard
  /// that time alone turns has a surface that moves: nothing rests on it here.
  bool stops_at_jump(const GuardGroup& group, Index slot, int from,
                     const Eigen::VectorXd& approach) {
    const double resolution = resolution_along(approach, group);
    const auto is_before = [&](double d, double back) {
      fly(d);
      x1_ -= back * approach;
      return shows_side(t_ + d - back, slot, from);
    };
    if (!is_before(0.0, resolution)) return false;  // beyond its jump
    using namespace thresholds;
    const double clearly = state_roundings * resolution;  // so that the first distance is none
    double d = first_time(group, slot);
    while (is_before(d, clearly))
      if ((d *= look_growth) > longest_) return false;  // the flow stays at the jump
    double back = clearly;
    while (!is_before(d, back))
      if ((back *= 2.0) > stopped_share * d) return false;  // passed through
    const double later = look_growth * look_growth * d;
    return !is_before(later, look_growth * look_growth * look_growth * back) &&
           !time_turns(slot, from, later);
  }

 private:
  /// The largest number of which all values are whole multiples, by the algorithm of Euclid. If there
  /// is none, a number is left that is nearly negligible beside them.
  static double common_measure(std::initializer_list<double> values) {
    double largest = 0.0, measure = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    const double negligible = thresholds::negligible_measure * largest;
    for (double value : values)
      for (value = std::abs(value); value > negligible;)
        measure = std::exchange(value, std::abs(std::remainder(measure, value)));
    return measure;
  }

  Side follow(const GuardGroup& group, Index slot, double error, int expected) {
    Side result{.rounding = error};
    const bool opaque = group.is_opaque();
    double d = first_time(group, slot);
    for (double furthest = unknown;; d *= thresholds::look_growth) {
      const double g = guard_after(d, slot);
      const int side = sign_of(g);
      if (is_expected(side, expected) && is_beyond_doubt(g, error))
        return result.side = side, result.after = d, result;
      const double rounding = opaque ? 0.0 : rounding_after(d, slot, g);
      result.rounding = std::max(error, rounding);
      if (std::abs(g) > result.rounding && has_moved(group))
        return result.side = side, result.after = d, result;
      if (furthest == unknown) furthest = furthest_look(group, d);
      if (std::abs(g) > rounding && !opaque) furthest = longest_;
      if (d * thresholds::look_growth > furthest) return result;
    }
  }

  static bool is_expected(int side, int expected) {
    return side != 0 && (side == expected || expected == either_side);
  }

  /// The time of the last look, from that of the first: a little beyond a move by the tolerance.
  double furthest_look(const GuardGroup& group, double d) const {
    return std::min(
        longest_, std::max(thresholds::furthest_look * time_of_states(group), lift_time(group, d)));
  }

  /// Whether a guard moves as much as the states do.
  bool is_beyond_doubt(double g, double error) {
    return std::abs(g) > std::max(error, thresholds::doubtless_move * largest_move());
  }

  /// [s] in which the fastest of all states moves by its tolerance. It is the time scale if the
  /// rest of the run is too short to give one.
  double quickest() const {
    double time = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < f_.size(); ++i)
      time = std::min(time, (rtol_[i] * std::abs((*x_)[i]) + atol_[i]) / std::abs(f_[i]));
    return time;
  }

  /// Whether a guard at the state x1_ is on a side.
  bool shows_side(double t, Index slot, int side) {
    look(t, x1_, slot, g_);
    forget_looks();
    return side * g_[slot] > 0.0;
  }
  /// Whether the guard at the point of departure changes with the time alone, within d before and
  /// after.
  bool time_turns(Index slot, int from, double d) {
    x1_ = *x_;
    const bool now = shows_side(t_, slot, from);
    return shows_side(t_ - d, slot, from) != now || shows_side(t_ + d, slot, from) != now;
  }

  /// [s] in which a flow moves each state of some leaves by its rounding, and the time by its own. A
  /// state that hardly moves is ignored, as in find_first_time.
  double resolution_along(const Eigen::VectorXd& flow, const GuardGroup& group) const {
    double time = 0.0;
    for (int leaf : group.leaves) {
      const PlanLeaf& of = machine_->plan().leaves[leaf];
      for (Index i = of.x; i < of.x + of.nx; ++i) {
        const double one = thresholds::state_roundings * eps * std::abs((*x_)[i] / flow[i]);
        if (one <= thresholds::slow_state_of_run * longest_) time = std::max(time, one);
      }
    }
    return time + thresholds::time_roundings * eps * std::abs(t_);
  }

  /// The time after which curvature has moved the states by more than their own rounding, from f
  /// and f1 after d. At a tight tolerance it is longer than the time of a move by the tolerance.
  double lift_time(const GuardGroup& group, double d) const {
    double time = 0.0;
    for (int leaf : group.leaves) {
      const PlanLeaf& of = machine_->plan().leaves[leaf];
      for (Index i = of.x; i < of.x + of.nx; ++i) {
        const double bend = std::abs(f1_[i] - f_[i]) / d;
        if (bend > 0.0)
          time = std::max(time,
                          std::sqrt(thresholds::time_roundings * eps * std::abs((*x_)[i]) / bend));
      }
    }
    return std::min(thresholds::lift_times * time, thresholds::lift_of_run * longest_);
  }

  /// Whether each state that an opaque guard reads has moved by more than its rounding. True for
  /// all other guards.
  bool has_moved(const GuardGroup& group) const {
    if (!group.is_opaque()) return true;
    for (int leaf : group.leaves) {
      const PlanLeaf& of = machine_->plan().leaves[leaf];
      for (Index i = of.x; i < of.x + of.nx; ++i) {
        if (move_[i] != 0.0 &&
            std::abs(move_[i]) <= thresholds::state_roundings * eps * std::abs((*x_)[i]))
          return false;
      }
    }
    return true;
  }

  double longest_step_;  // [s]
};

}  // namespace saltus
