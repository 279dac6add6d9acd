// Departure: to which side of zero the flow takes a guard that is at zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/simulation/options.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// Follows the flow from (t, x) for a short time d along x + d/2 (f(x) + f(x + d f)), which is
/// correct to second order (to fourth if second order shows nothing). d grows until the guard has
/// left zero by more than its rounding: that is its side. A guard that stays within its rounding
/// has no side. The rounding is measured: it follows from the movement of the guard when x, and
/// with it f, is disturbed by a known relative amount.
class Departure {
 public:
  Departure(Machine& machine, const SimulatorOptions& options)
      : machine_(&machine),
        rtol_(options.rtol),
        atol_(options.atol),
        longest_step_(options.max_minor_step_size) {
    const Index n = machine.plan().nx;
    for (auto* v : {&f_, &f_disturbed_, &f1_, &x1_, &move_, &trial_}) v->setZero(n);
    const Index slots = machine.plan().guard_slots;
    for (auto* v : {&g_, &g0_, &g_disturbed_}) v->setOnes(slots);
    const std::size_t groups = machine.plan().guards.size();
    looked_at_.assign(groups, 0);
    for (std::size_t i = 0; i < groups; ++i) {
      for (Index k = 0; k < machine.plan().guards[i].size; ++k)
        group_of_.push_back(static_cast<int>(i));
    }
  }

  /// The side to which the flow takes a guard (0: none), and the rounding bound used to decide it.
  struct Side {
    int side = 0;
    double rounding = 0.0;
  };

  /// Sets the point to depart from; `longest` [s] bounds how far ahead it looks.
  void from(double t, const Eigen::VectorXd& x, double longest) {
    t_ = t, x_ = &x;
    machine_->derivative(t, x.data(), f_.data());
    longest_ = longest;  // a run of no length has sides too
    using namespace thresholds;
    if (longest < short_run)
      longest_ = std::max(longest, std::min(short_run, short_run_looks * quickest()));
    longest_ = std::min(longest_, longest_step_);  // the author knows of something as quick
    disturbed_ = false, ++departures_;
  }

  /// f at the point it departs from.
  const Eigen::VectorXd& flow() const noexcept { return f_; }

  /// What guards read, besides t and x, has changed.
  void forget_looks() noexcept { flight_ = {}; }

  /// Rounding of a guard at the point of departure.
  double rounding(Index slot) {
    forget_looks();
    x1_ = *x_;
    return rounding_after(0.0, slot, g0(slot));
  }

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
    const double d = first_time(group);
    const double near = (guard_after(0.5 * d, slot) - g0(slot)) / (0.5 * d);
    const double g = guard_after(d, slot), far = (g - g0(slot)) / d,
                 extrapolated = 2.0 * near - far;
    const double noise = std::max(thresholds::slope_noise * std::abs(far - near),
                                  4.0 * rounding_after(d, slot, g) / d);
    return std::abs(extrapolated) > noise ? extrapolated : 0.0;
  }

  /// A bound of |d g / d t| along the flow over at most `longest` [s], its rounding included.
  double speed(const GuardGroup& group, Index slot, double longest) {
    const double d = std::min(longest, thresholds::speed_looks * first_time(group));
    return std::abs(guard_after(d, slot) - g0(slot)) / d;
  }

  /// d g / d t along another flow f through (t, x), to first order.
  double slope_along(const Eigen::VectorXd& f, const GuardGroup& group, Index slot) {
    const double d = first_time(group);
    forget_looks();
    x1_ = *x_ + d * f;
    look(t_ + d, x1_, slot, g_);
    return (g_[slot] - g0(slot)) / d;
  }

 private:
  static constexpr double amount = thresholds::disturbance, eps = thresholds::eps;
  static constexpr double unknown = -1.0;

  /// The last flight: x1_, f1_ and move_ belong to it, and g_ to its end.
  struct Flight {
    std::int64_t departure = 0;  // none
    double d = 0.0;              // [s]
    bool fine = false;
    int group = -1;  // whose guards g_ has
    double largest_move = unknown;
  };
  /// The time of the first look for the guards of one group, from one departure.
  struct FirstLook {
    std::int64_t departure = 0;
    const GuardGroup* group = nullptr;
    double d = 0.0;  // [s]
  };

  Side follow(const GuardGroup& group, Index slot, double error, int expected) {
    Side result{.rounding = error};
    const bool opaque = group.is_opaque();
    double d = first_time(group);
    for (double furthest = unknown;; d *= thresholds::look_growth) {
      const double g = guard_after(d, slot);
      const int side = sign_of(g);
      const bool may_be = side != 0 && (side == expected || expected == either_side);
      if (may_be && is_beyond_doubt(g, error)) return result.side = side, result;
      const double rounding = opaque ? 0.0 : rounding_after(d, slot, g);
      result.rounding = std::max(error, rounding);
      if (std::abs(g) > result.rounding && has_moved(group)) return result.side = side, result;
      // The look ends a little beyond the tolerance: the solver finds later events.
      if (furthest == unknown)
        furthest = std::min(longest_, std::max(thresholds::furthest_look * d, lift_time(group, d)));
      if (std::abs(g) > rounding && !opaque) furthest = longest_;
      if (d * thresholds::look_growth > furthest) return result;
    }
  }

  /// Whether a guard moves as much as the states do.
  bool is_beyond_doubt(double g, double error) {
    return std::abs(g) > std::max(error, thresholds::doubtless_move * largest_move());
  }

  /// Evaluates the group of one guard. All guards would cost n squared where n of them depart.
  void look(double t, const Eigen::VectorXd& x, Index slot, Eigen::VectorXd& g) {
    machine_->guards_of({&group_of_[slot], 1}, t, x.data(), g.data());
  }

  /// The guard at the point of departure, computed at the first call.
  double g0(Index slot) {
    std::int64_t& looked_at = looked_at_[group_of_[slot]];
    if (looked_at != departures_) look(t_, *x_, slot, g0_);
    looked_at = departures_;
    return g0_[slot];
  }

  double largest_move() {
    if (flight_.largest_move == unknown)
      flight_.largest_move = move_.size() > 0 ? move_.cwiseAbs().maxCoeff() : 0.0;
    return flight_.largest_move;
  }

  /// Calls move(i, weight) for each state. The weights, from 0.5 to 1 of either sign, have no
  /// pattern, so that terms which cancel in a guard do not cancel in the disturbance.
  template <class Move>
  static void disturb_by(Index n, Move move) {
    double weight = 0.618;
    for (Index i = 0; i < n; ++i) {
      move(i, weight < 0.5 ? -0.5 - weight : weight);
      weight += 0.618033988749895;
      if (weight >= 1.0) weight -= 1.0;
    }
  }
  static void disturb(Eigen::VectorXd& x) {
    disturb_by(x.size(), [&](Index i, double weight) { x[i] *= 1.0 + amount * weight; });
  }

  /// How far a guard at the point of departure moves if each state moves by its own tolerance.
  double moved_by_tolerances(Index slot) {
    const double before = g0(slot);
    trial_ = *x_;
    disturb_by(trial_.size(), [&](Index i, double weight) {
      trial_[i] += weight * (rtol_[i] * std::abs(trial_[i]) + atol_[i]);
    });
    look(t_, trial_, slot, g_disturbed_);
    return std::abs(g_disturbed_[slot] - before) + rounding(slot);
  }

  /// [s] in which the fastest of all states moves by its tolerance. It is the time scale if the
  /// rest of the run is too short to give one.
  double quickest() const {
    double time = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < f_.size(); ++i)
      time = std::min(time, (rtol_[i] * std::abs((*x_)[i]) + atol_[i]) / std::abs(f_[i]));
    return time;
  }

  /// The time in which the fastest state that the guard depends on moves by its tolerance. A state
  /// that hardly moves so far within the run is ignored: then the time or another block moves the
  /// guard.
  double first_time(const GuardGroup& group) {
    if (first_.departure != departures_ || first_.group != &group)
      first_ = {departures_, &group, find_first_time(group)};
    return first_.d;
  }
  double find_first_time(const GuardGroup& group) const {
    double d = thresholds::first_look_of_run * longest_;  // for a guard that no state moves
    bool moved = false;
    for (int leaf : group.leaves) {
      const PlanLeaf& of = machine_->plan().leaves[leaf];
      for (Index i = of.x; i < of.x + of.nx; ++i) {
        const double time = (rtol_[i] * std::abs((*x_)[i]) + atol_[i]) / std::abs(f_[i]);
        if (!(time <= thresholds::slow_state_of_run * longest_)) continue;
        d = moved ? std::min(d, time) : time;
        moved = true;
      }
    }
    return std::max(d, thresholds::time_roundings * eps * std::abs(t_));
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

  /// A guard after the time d. The flight, and the look at its group, serve all guards that depart
  /// together: n balls that land together take one of each.
  double guard_after(double d, Index slot) {
    if (flight_.departure != departures_ || flight_.d != d || flight_.fine != fine_) fly(d);
    const int group = group_of_[slot];
    if (flight_.group != group) look(t_ + d, x1_, slot, g_);
    flight_.group = group;
    return g_[slot];
  }

  /// Sets x1_ to the state after d, and move_ to the way there.
  void fly(double d) {
    forget_looks();
    x1_ = *x_ + (fine_ ? 0.5 * d : d) * f_;
    machine_->derivative(t_ + (fine_ ? 0.5 * d : d), x1_.data(), f1_.data());
    if (fine_)
      add_middle_and_end(d);
    else
      move_ = 0.5 * d * (f_ + f1_);
    x1_ = *x_ + move_;
    flight_.departure = departures_, flight_.d = d, flight_.fine = fine_;
  }

  /// Completes a step of the classical method of order 4 after its second stage, f1_ (Hairer,
  /// Norsett, Wanner I, p. 138, table 1.2).
  void add_middle_and_end(double d) {
    move_ = f_ + 2.0 * f1_;
    x1_ = *x_ + 0.5 * d * f1_;
    machine_->derivative(t_ + 0.5 * d, x1_.data(), f1_.data());
    move_ += 2.0 * f1_;
    x1_ = *x_ + d * f1_;
    machine_->derivative(t_ + d, x1_.data(), f1_.data());
    move_ = (d / 6.0) * (move_ + f1_);
  }

  /// Sixteen units of rounding in x, in f and in t, carried through the guard.
  double rounding_after(double d, Index slot, double g) {
    if (!disturbed_) {
      trial_ = *x_;
      disturb(trial_);
      machine_->derivative(t_, trial_.data(), f_disturbed_.data());
      disturbed_ = true;
    }
    trial_ = x1_;
    disturb(trial_);
    look(t_ + d, trial_, slot, g_disturbed_);
    const double through_x = std::abs(g_disturbed_[slot] - g);
    trial_ = x1_ + d * (f_disturbed_ - f_);
    look(t_ + d, trial_, slot, g_disturbed_);
    const double through_f = std::abs(g_disturbed_[slot] - g);
    look(t_ + d + thresholds::time_roundings * eps * std::abs(t_), x1_, slot, g_disturbed_);
    return thresholds::state_roundings * eps / amount * (through_x + through_f) +
           0.25 * std::abs(g_disturbed_[slot] - g);
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

  Machine* machine_;
  Tolerance rtol_, atol_;
  double longest_step_;
  double t_ = 0.0, longest_ = 0.0;
  const Eigen::VectorXd* x_ = nullptr;
  bool fine_ = false;             // follow the flow with order 4
  bool disturbed_ = false;        // f_disturbed_ belongs to x_
  List<int> group_of_;            // of each slot
  List<std::int64_t> looked_at_;  // of each group: the departure that g0_ belongs to
  std::int64_t departures_ = 0;
  Flight flight_;
  FirstLook first_;
  Eigen::VectorXd f_, f_disturbed_, f1_, x1_, move_, trial_, g_, g0_, g_disturbed_;
};

}  // namespace saltus
