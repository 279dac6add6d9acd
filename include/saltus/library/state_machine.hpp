// One of several named states is active; transitions lead from one to another.
// in: one scalar for each name of `inputs`. Outputs, scalar and held: `state`, the position of the
// active state, 0 for the first; one for each variable; those of `outputs`. Parameters: as named.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "saltus/library/state_machine_transition.hpp"

namespace saltus {

namespace detail {
struct StateMachineLayout;
}

/// An output of a state machine: a number for each state, or a function of the values.
struct StateMachineOutput {
  std::string name;
  std::map<std::string, double> levels = {};  ///< state -> number; 0 in a state that is not named
  std::function<double(const StateMachineValues&)> function = {};  ///< in place of `levels`
  Reads reads = Reads::everything;                                 ///< what the function reads
};

struct StateMachineOptions {
  std::vector<std::string> states;  ///< the first is active at the start, unless `initial` is given
  std::vector<StateMachineTransition> transitions = {};
  std::vector<std::string> inputs = {};
  std::vector<std::pair<std::string, double>> variables = {};  ///< name, number at the start
  std::map<std::string, StateMachineAction> entry = {};        ///< state -> when it is entered
  std::map<std::string, StateMachineAction> exit = {};         ///< state -> when it is left
  std::vector<StateMachineOutput> outputs = {};
  std::vector<std::pair<std::string, double>> parameters = {};  ///< name, value in a context
  std::string initial = {};
};

/// At a transition the action of exit of the source, that of the transition, and that of entry of
/// the target run in this order. The action of entry of the first state runs at the start.
///
/// A state that is entered may be left at once: the next transition is then taken at the same time.
/// If this comes to no end, the run ends with the error of `SimulatorOptions::max_passes`, which
/// names the transitions. The event log has a trigger also where a transition of a higher priority
/// was taken, or the guard beside it was false. Before the first state is entered, the mode of the
/// block is the number of states.
///
/// Throws BlockParameterError if there is no state, a name is unknown or used twice, a transition
/// has no condition, or both a trigger and `after`, or `after` is not a finite time above 0.
class StateMachine final : public LeafSystem {
 public:
  using Options = StateMachineOptions;
  using Condition = StateMachineCondition;
  using Action = StateMachineAction;
  using Transition = StateMachineTransition;
  using Output = StateMachineOutput;

  StateMachine(std::string name, const Options& options);

  /// The names of the states, in the order of their positions.
  const std::vector<std::string>& states() const noexcept { return states_; }

 private:
  int position(const std::string& state, const std::string& where) const;
  detail::StateMachineLayout layout() const;
  void declare_outputs(const Options& options);
  void declare_output(const Output& output);
  void declare_start(const Action& entry);
  void declare_transitions(const Options& options);

  std::vector<std::string> states_;
  int first_ = 0;
};

}  // namespace saltus
