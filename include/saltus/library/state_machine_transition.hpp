// The transitions of a StateMachine, and what their functions read and write.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "saltus/library/detail/callable.hpp"

namespace saltus {

/// The values that the functions of a state machine read. Inputs, variables and parameters are in
/// the order in which the machine names them.
struct StateMachineValues {
  double time;           ///< [s]
  double since;          ///< [s] the time since the active state was entered
  int state;             ///< the position of the active state
  Inputs inputs;         ///< `inputs(k)` is the number at input k
  VectorView variables;  ///< in an action: as the actions before it left them
  VectorView parameters;
};

/// A callable over the values that returns a truth, or a number that counts as true where it is not
/// below 0. The change of a truth is located by bisection, and a truth that is true for less than
/// the distance of two looks at a step may be missed. A number is located as smoothly as any guard.
class StateMachineCondition {
 public:
  StateMachineCondition() = default;
  template <std::invocable<const StateMachineValues&> Function>
  StateMachineCondition(Function function)  // NOLINT(google-explicit-constructor): reads as a name
      : residual_([function = std::move(function)](const StateMachineValues& now) -> double {
          using Result = std::invoke_result_t<const Function&, const StateMachineValues&>;
          static_assert(detail::Truth<Result> || std::floating_point<Result>,
                        "expected a function that returns bool or double");
          if constexpr (detail::Truth<Result>)
            return function(now) ? 1.0 : -1.0;
          else
            return static_cast<double>(function(now));
        }) {}

  explicit operator bool() const noexcept { return static_cast<bool>(residual_); }
  /// The number; 1 or -1 for a truth.
  double residual(const StateMachineValues& now) const { return residual_(now); }
  bool holds(const StateMachineValues& now) const { return residual_(now) >= 0.0; }

 private:
  std::function<double(const StateMachineValues&)> residual_;
};

/// Writes new values of the variables. What it has written is in `now.variables` too.
using StateMachineAction = std::function<void(const StateMachineValues& now, VectorRef variables)>;

/// A transition from the state `source` to the state `target`. It is taken
/// - with a guard, as soon as that is true, also where it is true when `source` is entered;
/// - with a trigger, each time that becomes true while `source` is active; a guard beside it has to
///   be true at that time;
/// - with `after`, that time after `source` was entered; a guard beside it has to be true, then or
///   later.
///
/// Of the transitions from one state that could be taken at one time, that with the highest priority
/// is taken; of equal ones the first in the list. A transition from a state to itself leaves and
/// enters it; its guard is then taken anew only after it was false.
struct StateMachineTransition {
  std::string source;
  std::string target;
  StateMachineCondition guard = {};
  StateMachineCondition trigger = {};
  std::optional<double> after = {};  ///< [s] above 0
  StateMachineAction action = {};    ///< in between the actions of exit and entry
  double priority = 0.0;
  std::string name = {};  ///< of the event; if empty, it is "source_to_target"
};

}  // namespace saltus
