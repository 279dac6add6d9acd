// One of several named states is active; transitions lead from one to another.
#include "saltus/library/state_machine.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "saltus/library/detail/state_machine_names.hpp"
#include "saltus/library/detail/state_machine_step.hpp"

namespace saltus {

namespace {

StateMachineAction action_of(const std::map<std::string, StateMachineAction>& actions,
                             const std::string& state) {
  const auto found = actions.find(state);
  return found == actions.end() ? StateMachineAction{} : found->second;
}

/// The positions of transitions by falling priority; those of equal priority stay in their order.
std::vector<std::size_t> by_priority(const std::vector<StateMachineTransition>& transitions) {
  std::vector<std::size_t> order(transitions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return transitions[a].priority > transitions[b].priority;
  });
  return order;
}

}  // namespace

StateMachine::StateMachine(std::string name, const Options& options)
    : LeafSystem(std::move(name)), states_(options.states) {
  detail::require_names(this->name(), options);
  if (!options.initial.empty()) first_ = position(options.initial, "initial");
  std::vector<double> z(detail::first_variable);
  for (const auto& [variable, value] : options.variables) z.push_back(value);
  declare_default_mode(static_cast<int>(states_.size()));  // no state is entered before a run
  declare_discrete_state(VectorView(z.data(), static_cast<Index>(z.size())));
  for (const auto& [parameter, value] : options.parameters)
    declare_dynamic_parameter(parameter, value);
  for (const std::string& input : options.inputs)
    declare_input_port({.name = input, .shape = Shape::scalar()});
  declare_outputs(options);
  declare_start(action_of(options.entry, nth(states_, first_)));
  declare_transitions(options);
}

int StateMachine::position(const std::string& state, const std::string& where) const {
  return detail::position_of(state, states_, name(), where);
}

detail::StateMachineLayout StateMachine::layout() const {
  return {.states = static_cast<int>(states_.size()), .first = first_};
}

void StateMachine::declare_outputs(const Options& options) {
  Output state{.name = "state"};
  for (double k = 0.0; const std::string& each : states_) state.levels[each] = k++;
  declare_output(state);
  for (Index k = detail::first_variable; const auto& [variable, value] : options.variables)
    declare_output_port({.name = variable, .view = Place{Space::z, k++, 1}});
  for (const Output& output : options.outputs) declare_output(output);
}

void StateMachine::declare_output(const Output& output) {
  if (output.function) {
    declare_output_port({.name = output.name,
                         .calc = [function = output.function, layout = layout()](
                                     const At& at) { return function(layout.values(at)); },
                         .reads = output.reads});
    return;
  }
  std::vector<double> levels(states_.size());
  for (const auto& [state, level] : output.levels)
    nth(levels, position(state, text("output '", output.name, "'"))) = level;
  levels.push_back(nth(levels, first_));  // before the start
  declare_output_port({.name = output.name,
                       .calc = [levels](const At& at) { return nth(levels, at.mode); },
                       .reads = Reads::mode});
}

/// Enters the first state, when a run starts for the first time.
void StateMachine::declare_start(const Action& entry) {
  const auto enter = [layout = layout(), entry](const At& at, Next& next) {
    layout.enter(layout.first, {}, entry, at, next);
  };
  declare_zero_crossing({.name = "start",
                         .guard = [](const At&) { return 1.0; },
                         .reset_map = enter,
                         .direction = Direction::negative_then_non_negative,
                         .start_mode = static_cast<int>(states_.size()),
                         .at_start = AtStart::fire,
                         .zeno_tolerance = 0.0,
                         .inputs = std::vector<int>{}});
}

void StateMachine::declare_transitions(const Options& options) {
  const std::vector<std::string> events = detail::events_of(options.transitions);
  std::vector<std::vector<detail::StateMachineDue>> before(states_.size());
  std::set<int> returns;  // the states with a transition to themselves so far
  for (const std::size_t k : by_priority(options.transitions)) {
    const Transition& each = options.transitions[k];
    const std::string where = text("transition '", events[k], "'");
    const int source = position(each.source, where), target = position(each.target, where);
    detail::require_condition(name(), each, where);
    const detail::StateMachineStep step{
        .layout = layout(),
        .source = source,
        .target = target,
        .due = {each.guard, each.after},
        .trigger = each.trigger,
        .leave = {action_of(options.exit, each.source), each.action},
        .entry = action_of(options.entry, each.target),
        .before = nth(before, source),
        .behind_return = returns.contains(source),
        .beside_triggers = std::ranges::any_of(options.transitions, [&](const Transition& other) {
          return other.trigger && other.source == each.source;
        })};
    declare_zero_crossing(step.crossing(events[k]));
    if (target == source) returns.insert(source);
    if (!each.trigger && target != source) nth(before, source).push_back(step.due);
  }
}

}  // namespace saltus
