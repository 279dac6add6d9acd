// Departure: to which side of zero the flow takes a guard that stands at zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/plan/machine.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// Follows the flow from (t, x) for a short time d along x + d/2 (f(x) + f(x + d f)), right to second order, and
/// lets d grow until the guard has left zero by more than rounding explains: that is its side. A guard that stays
/// within rounding has none. Rounding is measured, not guessed: how much the guard moves when x, and with it f,
/// is disturbed by a known relative amount.
class Departure {
 public:
  Departure(Machine& machine, const SimulatorOptions& options)
      : machine_(&machine), rtol_(options.rtol), atol_(options.atol) {
    const Index n = machine.plan().nx;
    for (auto* v : {&f_, &f_disturbed_, &f1_, &x1_, &move_, &trial_}) v->setZero(n);
    const Index slots = machine.plan().guard_slots;
    for (auto* v : {&g_, &g0_, &g_disturbed_}) v->setOnes(slots);
  }

  /// What the flow does to one guard: the side it takes (0: none), its slope, and the rounding it was told from.
  struct Side {
    int side = 0;
    double slope = 0.0;
    double rounding = 0.0;
  };

  /// Sets the point to depart from; `longest` [s] bounds how far ahead it looks.
  void from(double t, const Eigen::VectorXd& x, double longest) {
    t_ = t, x_ = &x, longest_ = longest;
    machine_->derivative(t, x.data(), f_.data());
    trial_ = x;
    disturb(trial_);
    machine_->derivative(t, trial_.data(), f_disturbed_.data());
    machine_->guards(t, x.data(), g0_.data());
  }

  /// `hair`: a guard within it is at zero too, and is followed until it has left that as well.
  Side of(const GuardGroup& group, Index slot, double hair) {
    Side result;
    const bool opaque = group.kind == GuardGroup::Kind::opaque;
    double d = first_time(group);
    // Not much further than the tolerance sees: what lies behind is the solver's to find.
    double furthest = std::min(longest_, 3e5 * d);
    result.slope = (guard_after(d, slot) - g0_[slot]) / d;
    for (; d <= furthest; d *= 8.0) {
      const double g = guard_after(d, slot);
      const double rounding = opaque ? 0.0 : rounding_after(d, slot, g);
      result.rounding = std::max(hair, rounding);
      if (opaque && !has_moved(group)) continue;
      if (std::abs(g) > result.rounding) {
        result.side = g > 0.0 ? 1 : -1;
        break;
      }
      if (std::abs(g) > rounding) furthest = longest_;
    }
    return result;
  }

  /// d g / d t along the flow at (t, x), by a forward difference over the same time that `of` starts with.
  double slope(const GuardGroup& group, Index slot) {
    const double d = first_time(group);
    return (guard_after(d, slot) - g0_[slot]) / d;
  }

 private:
  static constexpr double amount = 1e-7;  // of the disturbance: large against rounding, small against curvature
  static constexpr double eps = std::numeric_limits<double>::epsilon();

  /// Weights without pattern, so that what cancels in a guard does not cancel in the disturbance.
  static void disturb(Eigen::VectorXd& x) {
    double weight = 0.618;
    for (double& value : x) {
      value *= 1.0 + amount * (weight < 0.5 ? -0.5 - weight : weight);
      weight += 0.618033988749895;
      if (weight >= 1.0) weight -= 1.0;
    }
  }

  /// The time in which the fastest state the guard depends on moves by its tolerance.
  double first_time(const GuardGroup& group) const {
    double d = 1e-9 * longest_;  // for a guard that no state moves
    bool moved = false;
    for (int leaf : group.leaves) {
      const PlanLeaf& of = machine_->plan().leaves[static_cast<std::size_t>(leaf)];
      for (Index i = of.x; i < of.x + of.nx; ++i) {
        if (f_[i] == 0.0) continue;
        const double time = (rtol_ * std::abs((*x_)[i]) + atol_) / std::abs(f_[i]);
        d = moved ? std::min(d, time) : std::min(longest_, time);
        moved = true;
      }
    }
    return std::max(d, 64.0 * eps * std::abs(t_));
  }

  double guard_after(double d, Index slot) {
    x1_ = *x_ + d * f_;
    machine_->derivative(t_ + d, x1_.data(), f1_.data());
    move_ = 0.5 * d * (f_ + f1_);
    x1_ = *x_ + move_;
    machine_->guards(t_ + d, x1_.data(), g_.data());
    return g_[slot];
  }

  /// Sixteen units of rounding in x and in f, carried through the guard.
  double rounding_after(double d, Index slot, double g) {
    trial_ = x1_;
    disturb(trial_);
    machine_->guards(t_ + d, trial_.data(), g_disturbed_.data());
    const double through_x = std::abs(g_disturbed_[slot] - g);
    trial_ = x1_ + d * (f_disturbed_ - f_);
    machine_->guards(t_ + d, trial_.data(), g_disturbed_.data());
    return 16.0 * eps / amount * (through_x + std::abs(g_disturbed_[slot] - g));
  }

  /// For a guard that only says yes or no: whether each state it reads has moved by more than its rounding.
  bool has_moved(const GuardGroup& group) const {
    for (int leaf : group.leaves) {
      const PlanLeaf& of = machine_->plan().leaves[static_cast<std::size_t>(leaf)];
      for (Index i = of.x; i < of.x + of.nx; ++i) {
        if (move_[i] != 0.0 && std::abs(move_[i]) <= 16.0 * eps * std::abs((*x_)[i])) return false;
      }
    }
    return true;
  }

  Machine* machine_;
  double rtol_, atol_;
  double t_ = 0.0, longest_ = 0.0;
  const Eigen::VectorXd* x_ = nullptr;
  Eigen::VectorXd f_, f_disturbed_, f1_, x1_, move_, trial_, g_, g0_, g_disturbed_;
};

}  // namespace saltus
