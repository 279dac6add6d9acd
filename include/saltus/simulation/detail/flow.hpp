// Flow: to which side the flow takes a guard at the present state, computed when it is needed.
#pragma once

#include <span>

#include "saltus/simulation/detail/crossing_decisions.hpp"
#include "saltus/simulation/detail/departure.hpp"

namespace saltus {

/// Keeps the departure from the present (t, x) until something that f reads is written.
class Flow {
 public:
  Flow(Machine& machine, const SimulatorOptions& options)
      : machine_(&machine), departure_(machine, options) {}

  /// An instant begins at t; `longest` [s] bounds how far ahead the flow is followed.
  void open(double t, double longest) { t_ = t, longest_ = longest, known_ = false; }
  /// The state, or something else that f reads, was written.
  void forget() noexcept { known_ = false; }
  /// Guards read other values than before, though f may not.
  void forget_looks() noexcept { departure_.forget_looks(); }
  /// The values of one guard count from `zero`, in place of its own zero; -1: of none.
  void count_from(Index slot, double zero) { departure_.count_from(slot, zero); }
  /// f at the present state, if it is known.
  const Eigen::VectorXd* known() const noexcept { return known_ ? &departure_.flow() : nullptr; }

  /// The side to which the flow takes a guard from the present state: see Departure::of.
  Departure::Side side(const GuardGroup& group, Index slot, double error, int expected) {
    depart();
    return departure_.of(group, slot, error, expected);
  }
  /// dg/dt along the flow from the present state.
  double slope(const GuardGroup& group, Index slot) {
    depart();
    return departure_.slope(group, slot);
  }
  /// Whether that slope is above the rounding of the values of the guard.
  bool is_slope_sure(const GuardGroup& group, Index slot) {
    depart();
    return departure_.is_slope_sure(group, slot);
  }
  /// Whether these states move together, and the guard does not: see Departure::moves_together.
  bool moves_together(const GuardGroup& group, Index slot, std::span<const Index> states) {
    depart();
    return departure_.moves_together(group, slot, states);
  }
  /// The rounding of a guard at the present state.
  double rounding(Index slot) {
    depart();
    return departure_.rounding(slot);
  }
  /// The value of a guard on the flow d [s] later.
  double value_after(double d, Index slot) {
    depart();
    return departure_.guard_after(d, slot);
  }
  /// dg/dt along another f through the point that the last call departed from.
  double slope_along(const Eigen::VectorXd& f, const GuardGroup& group, Index slot) {
    return departure_.slope_along(f, group, slot);
  }

  /// dg/dt along the flow from another state.
  double slope_from(const Eigen::VectorXd& x, const GuardGroup& group, Index slot) {
    depart_from(x, longest_);
    return departure_.slope(group, slot);
  }
  /// A bound of |dg/dt| along the flow from another state, over at most `longest` [s].
  double speed_from(const Eigen::VectorXd& x, const GuardGroup& group, Index slot, double longest) {
    depart_from(x, longest_);
    return departure_.speed(group, slot, longest);
  }
  /// The side to which the flow takes a guard within at most `longest` [s].
  Departure::Side side_within(double longest, const GuardGroup& group, Index slot, double error,
                              int expected) {
    depart_from(machine_->x, longest);
    return departure_.of(group, slot, error, expected);
  }
  /// Whether the flow after a reset leads straight back across a guard that fired coming from
  /// `from`: nothing can move until another block does. False if the guard was merely passed
  /// through: then the flow from x_before, before the reset, had the same direction.
  bool leads_back(const GuardGroup& group, Index slot, int from, const Eigen::VectorXd& x_before) {
    const bool known = known_;
    const double onward = -from * slope(group, slot);
    known_ = known;
    if (!(onward > 0.0)) return true;
    return !passed_through(onward, -from * slope_from(x_before, group, slot));
  }
  /// Whether the states are at the jump of a guard that came from `from`, and leave it as from rest:
  /// see Departure::stops_at_jump. The flow before the reset is that from x_before.
  bool stops_at_jump(const GuardGroup& group, Index slot, int from,
                     const Eigen::VectorXd& x_before) {
    depart_from(x_before, longest_);
    approach_ = departure_.flow();
    depart();
    return departure_.stops_at_jump(group, slot, from, approach_);
  }
  /// The error of a guard at the present state by the tolerance of the run; zero for an opaque
  /// guard, which is only a sign.
  double tolerance(Index slot, bool opaque) {
    depart_from(machine_->x, longest_);
    return opaque ? 0.0 : departure_.tolerance(slot);
  }

 private:
  void depart() {
    if (!known_) departure_.from(t_, machine_->x, longest_);
    known_ = true;
  }
  void depart_from(const Eigen::VectorXd& x, double longest) {
    departure_.from(t_, x, longest);
    known_ = false;
  }

  Machine* machine_;
  Departure departure_;
  double t_ = 0.0, longest_ = 0.0;
  bool known_ = false;        // departure_ belongs to the present state
  Eigen::VectorXd approach_;  // the flow before a reset
};

}  // namespace saltus
