// Flow probe: the flow from a point for a short time, a guard along it, and the rounding of that
// guard.
#pragma once

#include <cstdint>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/simulation/detail/guard_looks.hpp"
#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// Follows the flow from (t, x) for a time d along x + d/2 (f(x) + f(x + d f)), which is correct to
/// second order, or along a step of the classical method of order 4. The rounding of a guard is
/// measured: it follows from the movement of the guard when x, and with it f, is disturbed by a
/// known relative amount.
class FlowProbe {
 public:
  /// f at the point it departs from.
  const Eigen::VectorXd& flow() const noexcept { return f_; }

  /// What guards read, besides t and x, has changed.
  void forget_looks() noexcept { flight_ = {}; }

  /// From now on the values of one guard count from `zero`, in place of its own zero; -1: of none.
  void count_from(Index slot, double zero) {
    if (looks_.shifted() >= 0) looked_at_[looks_.group(looks_.shifted())] = 0;
    looks_.count_from(slot, zero);
    if (slot >= 0) looked_at_[looks_.group(slot)] = 0;
    forget_looks();
  }

  /// Rounding of a guard at the point of departure.
  double rounding(Index slot) {
    forget_looks();
    x1_ = *x_;
    return rounding_after(0.0, slot, g0(slot));
  }

 protected:
  static constexpr double amount = thresholds::disturbance, eps = thresholds::eps;
  static constexpr double unknown = -1.0;

  FlowProbe(Machine& machine, const SimulatorOptions& options)
      : machine_(&machine), rtol_(options.rtol), atol_(options.atol), looks_(machine) {
    const Index n = machine.plan().nx;
    for (auto* v : {&f_, &f_disturbed_, &f1_, &x1_, &move_, &trial_}) v->setZero(n);
    const Index slots = machine.plan().look_slots;
    for (auto* v : {&g_, &g0_, &g_disturbed_}) v->setOnes(slots);
    looked_at_.assign(machine.plan().guards.size(), 0);
  }

  /// Sets the point to depart from.
  void start(double t, const Eigen::VectorXd& x) {
    t_ = t, x_ = &x;
    machine_->derivative(t, x.data(), f_.data());
    disturbed_ = false, ++departures_;
  }

  int group_of(Index slot) const { return looks_.group(slot); }

  /// The number of the present point among all departures.
  std::int64_t departure() const noexcept { return departures_; }

  /// A guard after the time d. The flight, and the look at its group, serve all guards that depart
  /// together: n balls that land together take one of each.
  double guard_after(double d, Index slot) {
    if (flight_.departure != departures_ || flight_.d != d || flight_.fine != fine_) fly(d);
    const int group = looks_.group(slot);
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

  void look(double t, const Eigen::VectorXd& x, Index slot, Eigen::VectorXd& g) {
    looks_.look(t, x, slot, g);
  }

  /// The guard at the point of departure, computed at the first call.
  double g0(Index slot) {
    std::int64_t& looked_at = looked_at_[looks_.group(slot)];
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

  Machine* machine_;
  Tolerance rtol_, atol_;
  double t_ = 0.0;
  const Eigen::VectorXd* x_ = nullptr;
  bool fine_ = false;  // follow the flow with order 4
  Eigen::VectorXd f_, f1_, x1_, move_, g_;

 private:
  /// The last flight: x1_, f1_ and move_ belong to it, and g_ to its end.
  struct Flight {
    std::int64_t departure = 0;  // none
    double d = 0.0;              // [s]
    bool fine = false;
    int group = -1;  // whose guards g_ has
    double largest_move = unknown;
  };

  GuardLooks looks_;
  bool disturbed_ = false;        // f_disturbed_ belongs to x_
  List<std::int64_t> looked_at_;  // of each group: the departure that g0_ belongs to
  std::int64_t departures_ = 0;
  Flight flight_;
  Eigen::VectorXd f_disturbed_, trial_, g0_, g_disturbed_;
};

}  // namespace saltus
