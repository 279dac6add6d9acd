// The names in a state machine: that each is known and used once, and the names of its events.
#include "saltus/library/detail/state_machine_names.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace saltus::detail {

namespace {

void require_once(const std::string& block, std::string_view what,
                  const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    insist(std::count(names.begin(), names.end(), name) == 1, block, "the ", what, " '", name,
           "' is there twice; expected each once");
  }
}

void append_names(const std::vector<std::pair<std::string, double>>& named,
                  std::vector<std::string>& names) {
  for (const auto& [name, value] : named) names.push_back(name);
}

}  // namespace

void require_names(const std::string& block, const StateMachineOptions& options) {
  insist(!options.states.empty(), block, "expected one state or more, found none");
  require_once(block, "state", options.states);
  std::vector<std::string> names = options.inputs, outputs = {"state"};
  append_names(options.variables, names);
  append_names(options.parameters, names);
  require_once(block, "name", names);
  append_names(options.variables, outputs);
  for (const StateMachineOutput& output : options.outputs) outputs.push_back(output.name);
  require_once(block, "output", outputs);
  for (const auto* actions : {&options.entry, &options.exit}) {
    for (const auto& [state, action] : *actions)
      position_of(state, options.states, block, actions == &options.entry ? "entry" : "exit");
  }
}

void require_condition(const std::string& block, const StateMachineTransition& transition,
                       const std::string& where) {
  insist(transition.guard || transition.trigger || transition.after, block, where,
         ": expected a guard, a trigger or a time 'after'");
  insist(!transition.trigger || !transition.after, block, where,
         ": expected a trigger or a time 'after', found both");
  const double after = transition.after.value_or(1.0);
  insist(std::isfinite(after) && after > 0.0, block, where, ": after = ", after,
         " s; expected a time above 0");
}

int position_of(const std::string& state, const std::vector<std::string>& states,
                const std::string& block, const std::string& where) {
  const auto found = std::find(states.begin(), states.end(), state);
  insist(found != states.end(), block, where, ": there is no state '", state, "'",
         known_names(state, states));
  return static_cast<int>(found - states.begin());
}

std::vector<std::string> events_of(const std::vector<StateMachineTransition>& transitions) {
  std::vector<std::string> events;
  std::map<std::string, int> count;
  for (const StateMachineTransition& each : transitions) {
    std::string name = each.name;
    if (name.empty()) {
      name = each.source + "_to_" + each.target;
      if (const int number = ++count[name]; number > 1) name += text(" ", number);
    }
    events.push_back(std::move(name));
  }
  return events;
}

}  // namespace saltus::detail
