// The checks and effects of the declare_* methods of LeafSystem.
#include "saltus/model/leaf_system.hpp"

#include <cmath>

#include "saltus/model/detail/names.hpp"

namespace saltus {

namespace {

/// Refuses a formula beside a function: two computations of one value could differ.
void take_formula(VectorFunction& function, const Formula& formula, std::string_view what,
                  const std::string& block) {
  if (!formula) return;
  if (function) {
    throw ModelError(
        text("block '", block, "': ", what, " has a function and a formula; expected one of them"));
  }
  function = formula.function();
}

/// Refuses options of a zero crossing that exclude each other, or that name a missing mode, state
/// or input.
void require_sound(const ZeroCrossing& c, const Declarations& declared, const std::string& block) {
  const auto refuse = [&](bool wrong, auto&&... why) {
    if (wrong) throw ModelError(text("block '", block, "': zero crossing '", c.name, "' ", why...));
  };
  refuse(!c.guard, "has no guard");
  refuse(c.size < 1, "has ", c.size, " guards; expected 1 or more");
  refuse(c.max_count < 1, "has max_count ", c.max_count, "; expected 1 or more");
  refuse(c.max_count > 1 && !c.terminal, "has max_count ", c.max_count,
         " but is not terminal; set terminal too");
  refuse(c.zeno_tolerance && !(*c.zeno_tolerance >= 0.0), "has zeno_tolerance ",
         c.zeno_tolerance.value_or(0.0), "; expected a time >= 0 s");
  refuse(!c.holds.empty() && static_cast<Index>(c.holds.size()) != c.size, "has ", c.size,
         " guards and ", c.holds.size(), " lists of states to hold; give one list for each guard");
  const Index n = declared.continuous.initial.size();
  for (const auto& states : c.holds) {
    for (int i : states)
      refuse(i < 0 || i >= n, "holds state ", i, "; the block has ", n,
             " continuous states, declared before it");
  }
  const std::string queue = c.is_queued() ? c.queue_fault() : "";
  refuse(!queue.empty(), queue);
}

}  // namespace

LeafSystem::LeafSystem(std::string name) : System(detail::without_dot(std::move(name), "block")) {
  declared_.use = std::make_shared<char>();
}
LeafSystem::~LeafSystem() = default;
LeafSystem::LeafSystem(LeafSystem&&) noexcept = default;
LeafSystem& LeafSystem::operator=(LeafSystem&&) noexcept = default;

void LeafSystem::require_unused() const {
  if (declared_.use.use_count() <= 1) return;
  throw ModelError(
      text("block '", name(),
           "' is in use by a simulator or a diagram, so it cannot declare more; declare everything "
           "before they are made, or make a new block"));
}

void LeafSystem::declare_continuous_state(Index n, RightHandSide ode) {
  declare_continuous_state({.initial = Eigen::VectorXd::Zero(n), .ode = std::move(ode)});
}

void LeafSystem::declare_jacobian(MatrixFunction jacobian) {
  require_unused();
  declared_.continuous.jacobian = std::move(jacobian);
}

void LeafSystem::declare_jacobian_sparsity(std::vector<MatrixEntry> entries) {
  require_unused();
  declared_.continuous.sparsity = std::move(entries);
}

void LeafSystem::declare_sparse_jacobian(std::vector<MatrixEntry> entries, VectorFunction values) {
  declare_jacobian_sparsity(std::move(entries));
  declared_.continuous.sparse_jacobian = std::move(values);
}

ParameterIndex LeafSystem::declare_dynamic_parameter(std::string name, double value) {
  return declare_dynamic_parameter(std::move(name), Eigen::VectorXd::Constant(1, value));
}

LeafPort LeafSystem::output_source(int index) const {
  const auto& sampler = declared_.outputs[index].sampler;
  return sampler ? LeafPort{sampler.get(), 0} : LeafPort{this, index};
}

LeafPort LeafSystem::input_target(int index) const { return {this, index}; }

std::vector<std::string> LeafSystem::input_names() const {
  return detail::names_of(declared_.inputs);
}
std::vector<std::string> LeafSystem::output_names() const {
  return detail::names_of(declared_.outputs);
}

/// The zero crossings come first, then the time events.
std::vector<std::string> LeafSystem::event_output_names() const {
  std::vector<std::string> names = detail::names_of(declared_.zero_crossings);
  for (const TimeEvent& event : declared_.time_events) names.push_back(event.name);
  return names;
}
std::vector<std::string> LeafSystem::event_input_names() const {
  return detail::names_of(declared_.event_inputs);
}
LeafEvent LeafSystem::event_source(int index) const {
  const auto& crossings = declared_.zero_crossings;
  return {this, index, index < std::ssize(crossings) ? crossings[index].size : 1};
}
LeafEvent LeafSystem::event_target(int index) const {
  return {this, index, declared_.event_inputs[index].size};
}

void LeafSystem::collect(Structure& out, const std::string& path) const {
  std::string known_as = path.empty() ? name() : path;
  out.systems.push_back({system_id(), known_as, out.leaves.size(), out.leaves.size() + 1});
  out.leaves.push_back({this, std::move(known_as)});
  collect_samplers(out);
  collect_fixed(out);
}

void LeafSystem::collect_samplers(Structure& out) const {
  const std::string path = out.leaves.back().path;
  for (std::size_t i = 0; i < declared_.outputs.size(); ++i) {
    const OutputDeclaration& output = nth(declared_.outputs, i);
    if (!output.sampler) continue;
    output.sampler->collect(out, path + "." + output.name);
    out.wires.push_back({{this, static_cast<int>(i)}, output.sampler->input_target(0)});
  }
}

/// Checks that all states have names or none has, and that each name is one word that nothing else
/// has.
void LeafSystem::require_state_names(const ContinuousState& state) const {
  const auto& names = state.names;
  if (!names.empty() && std::ssize(names) != state.initial.size())
    throw ModelError(text("block '", name(), "': continuous state: expected ", state.initial.size(),
                          " names, one for each state, found ", names.size()));
  for (const std::string& each : names) {
    const bool taken = each == "x" || each == "z" || each == "mode";
    if (each.empty() || taken || each.find_first_of("[].") != std::string::npos)
      throw ModelError(text("block '", name(), "': continuous state: '", each,
                            "' cannot be the name of a state; expected a word without dots and "
                            "brackets, other than 'x', 'z' and 'mode'"));
    if (std::ranges::count(names, each) > 1)
      throw ModelError(
          text("block '", name(), "': continuous state: the name '", each, "' is given twice"));
  }
}

void LeafSystem::declare_continuous_state(ContinuousState state) {
  require_unused();
  if (declared_.continuous.initial.size() > 0) {
    throw ModelError(
        text("block '", name(),
             "': the continuous state is declared twice; declare it once, as one vector"));
  }
  detail::require_finite(state.initial, text("block '", name(), "': initial continuous state"));
  if (state.ode.states != 0 && state.ode.states != state.initial.size()) {
    throw ModelError(
        text("block '", name(), "': the right-hand side is ",
             state.ode.steps != nullptr ? "inlined" : "written", " for ", state.ode.states,
             " continuous states, the block has ", state.initial.size(), "; say ",
             state.ode.steps != nullptr ? "inlined<" : "equations<", state.initial.size(), ">"));
  }
  require_state_names(state);
  take_formula(state.ode.function, state.formula, "the continuous state", name());
  if (!state.formula) state.formula = state.ode.formula;
  const ContinuousState& before = declared_.continuous;
  if (!state.jacobian) state.jacobian = before.jacobian;
  if (!state.sparsity) {
    state.sparsity = before.sparsity;
    state.sparse_jacobian = before.sparse_jacobian;
  }
  const std::vector<std::string> names = state.names;
  declared_.continuous = std::move(state);
  for (std::size_t i = 0; i < names.size(); ++i)
    declare_output_port({.name = names[i],
                         .shape = Shape::scalar(),
                         .reads = Reads::continuous_state,
                         .view = Place{Space::x, static_cast<Index>(i), 1}});
}

void LeafSystem::declare_discrete_state(const Eigen::VectorXd& initial) {
  require_unused();
  if (declared_.discrete.size() > 0) {
    throw ModelError(
        text("block '", name(),
             "': the discrete state is declared twice; declare it once, as one vector"));
  }
  detail::require_finite(initial, text("block '", name(), "': initial discrete state"));
  declared_.discrete = initial;
}

void LeafSystem::declare_history(History history) {
  require_unused();
  const auto inputs = static_cast<int>(declared_.inputs.size());
  if (history.input < 0 || history.input >= inputs || !history.append ||
      !(history.longest_step > 0.0)) {
    throw ModelError(text("block '", name(), "': a history of input ", history.input,
                          " with a longest step of ", history.longest_step,
                          " s; expected one of the ", inputs,
                          " inputs, a function that appends, and a longest step above 0 s"));
  }
  declared_.histories.push_back(std::move(history));
}

void LeafSystem::declare_default_mode(int mode) {
  require_unused();
  declared_.mode = mode;
  declared_.has_modes = true;
}

ParameterIndex LeafSystem::declare_dynamic_parameter(std::string parameter,
                                                     const Eigen::VectorXd& value) {
  require_unused();
  detail::name_it(parameter, declared_.parameters, "parameter_", name());
  parameter = detail::without_dot(std::move(parameter), text("block '", name(), "': parameter"));
  detail::require_finite(value, text("block '", name(), "': parameter '", parameter, "'"));
  const ParameterIndex index{declared_.parameter_values.size(), value.size()};
  declared_.parameters.push_back({std::move(parameter), index.offset, index.size});
  declared_.parameter_values.conservativeResize(index.offset + index.size);
  declared_.parameter_values.tail(index.size) = value;
  return index;
}

void LeafSystem::declare_parameter_check(ParameterCheck check) {
  require_unused();
  const Eigen::VectorXd& values = declared_.parameter_values;
  check(name(), ParameterValues({values.data(), values.size()}));
  declared_.parameter_checks.push_back(std::move(check));
}

void LeafSystem::declare_start_check(StartCheck check) {
  require_unused();
  declared_.start_checks.push_back(std::move(check));
}

void LeafSystem::declare_seed(ParameterIndex seed) {
  require_unused();
  declared_.seed = seed;
}

void LeafSystem::declare_shared_outside() {
  require_unused();
  declared_.shares_outside = true;
}

int LeafSystem::declare_input_port(InputDeclaration input) {
  require_unused();
  detail::name_it(input.name, declared_.inputs, "in_", name());
  input.name = detail::without_dot(std::move(input.name), text("block '", name(), "': input"));
  declared_.inputs.push_back(std::move(input));
  return static_cast<int>(declared_.inputs.size()) - 1;
}

int LeafSystem::declare_output_port(OutputDeclaration output) {
  require_unused();
  detail::name_it(output.name, declared_.outputs, "out_", name());
  output.name = detail::without_dot(std::move(output.name), text("block '", name(), "': output"));
  take_formula(output.calc, output.formula, text("output '", output.name, "'"), name());
  if (!output.calc && !output.view) {
    throw ModelError(
        text("block '", name(), "': output '", output.name, "' has no function that computes it"));
  }
  if (output.sampler) {
    const Declarations& behind = output.sampler->declarations();
    if (behind.inputs.size() != 1 || behind.outputs.size() != 1)
      throw ModelError(text("block '", name(), "': output '", output.name, "': its sampler '",
                            output.sampler->name(), "' has ", behind.inputs.size(), " inputs and ",
                            behind.outputs.size(), " outputs; expected one of each"));
  }
  declared_.outputs.push_back(std::move(output));
  return static_cast<int>(declared_.outputs.size()) - 1;
}

int LeafSystem::declare_continuous_state_output(std::string port) {
  const Index n = declared_.continuous.initial.size();
  return declare_output_port({.name = std::move(port),
                              .shape = Shape::of(n),
                              .reads = Reads::continuous_state,
                              .view = Place{Space::x, 0, n}});
}

int LeafSystem::declare_discrete_state_output(std::string port) {
  const Index n = declared_.discrete.size();
  return declare_output_port({.name = std::move(port),
                              .shape = Shape::of(n),
                              .reads = Reads::discrete_state,
                              .view = Place{Space::z, 0, n}});
}

int LeafSystem::declare_mode_output(std::string port) {
  return declare_output_port({.name = std::move(port),
                              .calc = [](const At& at) { return at.mode; },
                              .reads = Reads::mode});
}

int LeafSystem::declare_zero_crossing(ZeroCrossing crossing) {
  require_unused();
  detail::name_it(crossing.name, declared_.zero_crossings, "zero_crossing_", name());
  take_formula(crossing.guard, crossing.formula, text("zero crossing '", crossing.name, "'"),
               name());
  require_sound(crossing, declared_, name());
  declared_.zero_crossings.push_back(std::move(crossing));
  return static_cast<int>(declared_.zero_crossings.size()) - 1;
}

RelationIndex LeafSystem::declare_relation(Relation relation) {
  require_unused();
  detail::name_it(relation.name, declared_.relations, "relation_", name());
  take_formula(relation.guard, relation.formula, text("relation '", relation.name, "'"), name());
  if (!relation.guard) {
    throw ModelError(text("block '", name(), "': relation '", relation.name, "' has no guard"));
  }
  declared_.relations.push_back(std::move(relation));
  return {static_cast<int>(declared_.relations.size()) - 1};
}

void LeafSystem::declare_edge_reset(EdgeReset reset) {
  require_unused();
  detail::name_it(reset.name, declared_.edge_resets, "edge_reset_", name());
  if (!reset.reset_map) {
    throw ModelError(text("block '", name(), "': edge reset '", reset.name, "' has no reset map"));
  }
  declared_.edge_resets.push_back(std::move(reset));
}

void LeafSystem::declare_periodic_update(ResetMap update, double period, double offset,
                                         std::string event) {
  require_unused();
  detail::name_it(event, declared_.time_events, "periodic_", name());
  if (period == inherited_period && offset == 0.0) {
    return declare_time_event(
        {.name = std::move(event), .update = std::move(update), .inherited = true});
  }
  if (!(period > 0.0) || !std::isfinite(offset)) {
    throw ModelError(text("block '", name(), "': periodic update '", event, "': period ", period,
                          " s, offset ", offset, " s; expected period > 0 and a finite offset"));
  }
  declare_time_event(
      {.name = std::move(event), .update = std::move(update), .period = period, .offset = offset});
}

void LeafSystem::declare_one_shot(double time, ResetMap update, std::string event) {
  require_unused();
  detail::name_it(event, declared_.time_events, "one_shot_", name());
  if (!std::isfinite(time))
    throw ModelError(text("block '", name(), "': time event '", event, "' at ", time, " s"));
  declare_time_event({.name = std::move(event), .update = std::move(update), .offset = time});
}

void LeafSystem::declare_time_event(TimeEvent event) {
  detail::name_it(event.name, declared_.time_events, "time_event_", name());
  if (const std::string fault = event.fault(); !fault.empty())
    throw ModelError(text("block '", name(), "': time event '", event.name, "': ", fault));
  declared_.time_events.push_back(std::move(event));
}

int LeafSystem::declare_event_input(EventInputDeclaration input) {
  require_unused();
  detail::name_it(input.name, declared_.event_inputs, "event_in_", name());
  input.name =
      detail::without_dot(std::move(input.name), text("block '", name(), "': event input"));
  const std::string what = text("block '", name(), "': event input '", input.name, "' ");
  if (!input.reset_map) throw ModelError(text(what, "has no reset map"));
  if (input.size < 1)
    throw ModelError(text(what, "has ", input.size, " entries; expected 1 or more"));
  declared_.event_inputs.push_back(std::move(input));
  return static_cast<int>(declared_.event_inputs.size()) - 1;
}

}  // namespace saltus
