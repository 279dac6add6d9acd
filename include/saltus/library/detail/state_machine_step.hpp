// When a transition of a state machine is taken, and what it writes.
#pragma once

#include <optional>
#include <vector>

#include "saltus/library/state_machine_transition.hpp"

namespace saltus::detail {

/// The discrete state: the time at which the active state was entered, and the variables.
inline constexpr Index entered_at = 0;
inline constexpr Index first_variable = 1;

/// The part of a state machine that its functions need. They refer to no machine, which may move.
struct StateMachineLayout {
  int states;  ///< their number; before the start it is the mode
  int first;   ///< the position of the first state, which counts before the start too

  StateMachineValues values(const At& at, const double* variables) const;
  StateMachineValues values(const At& at) const { return values(at, at.z.data() + first_variable); }
  /// Leaves a state by some actions, and enters another one by an action.
  void enter(int target, const std::vector<StateMachineAction>& leave,
             const StateMachineAction& entry, const At& at, Next& next) const;
};

/// When a transition without a trigger is due.
struct StateMachineDue {
  StateMachineCondition guard;
  std::optional<double> after;  ///< [s]

  /// Not below zero where the transition is due.
  double residual(const StateMachineValues& now) const;
};

/// A transition with positions in place of names.
struct StateMachineStep {
  StateMachineLayout layout;
  int source, target;
  StateMachineDue due;
  StateMachineCondition trigger;
  std::vector<StateMachineAction> leave;  ///< those of the exit and of the transition
  StateMachineAction entry;
  std::vector<StateMachineDue> before;  ///< of the transitions that are taken in place of this one
  bool behind_return;    ///< whether a transition of the source to itself comes before it
  bool beside_triggers;  ///< whether another transition of the source has a trigger

  /// The guard of a transition without a trigger: not below zero where that is due. It is below
  /// zero in all other states, so that the pass that enters the state carries it across zero if it
  /// is due then. A guard of that mode alone would wait if it has fired at the same time before, and
  /// the transition would be lost. It is below zero, too, where one of `before` is due. It jumps
  /// over zero: within rounding of zero, a chain that comes back to the source would be lost.
  double residual(const At& at) const;
  /// Whether it is due still, where a transition of the source to itself may have been taken before
  /// it in this pass.
  bool is_still_due(const StateMachineValues& now) const;
  void take(const At& at, Next& next) const;
  ZeroCrossing crossing(const std::string& event) const;
};

}  // namespace saltus::detail
