// The names in a state machine: that each is known and used once, and the names of its events.
#pragma once

#include <string>
#include <vector>

#include "saltus/library/state_machine.hpp"

namespace saltus::detail {

/// Refuses a machine without states, and a name that is used twice.
void require_names(const std::string& block, const StateMachineOptions& options);

/// Refuses a transition without a condition, with a trigger and a time, and a time that is no time.
void require_condition(const std::string& block, const StateMachineTransition& transition,
                       const std::string& where);

/// The position of a state; a BlockParameterError with the nearest name if there is none.
int position_of(const std::string& state, const std::vector<std::string>& states,
                const std::string& block, const std::string& where);

/// The names of the events of transitions; a second transition between two states gets a number.
std::vector<std::string> events_of(const std::vector<StateMachineTransition>& transitions);

}  // namespace saltus::detail
