// ControlledLeaf: functions that ask for the control signal before they do anything.
#include "controlled_leaf.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace saltus::detail {

ControlledLeaf::ControlledLeaf(const PlanLeaf& leaf, const std::vector<int>& gated)
    : leaf_(leaf),
      gated_(gated),
      system_(*leaf.system),
      path_(leaf.path),
      declared_(leaf.declared()),
      own_(declared_.inputs.size()),
      control_(static_cast<int>(own_.size())) {
  std::iota(own_.begin(), own_.end(), 0);
  keep_to_own_inputs();
  declared_.inputs.push_back({.name = text("control ", control_), .shape = Shape::scalar()});
}

void ControlledLeaf::refuse(const std::string& what) const {
  throw ModelError(text("block '", path_, "': ", what));
}

ControlledLeaf::Named ControlledLeaf::with_control(const Named& named) const {
  Named inputs = own_or(named);
  inputs->push_back(control_);
  return inputs;
}

/// A rule for the shape of an output must not count the control signal as one of its operands.
void ControlledLeaf::keep_to_own_widths(OutputDeclaration& output) const {
  if (output.shape) return;
  const ShapeRule rule = output.shape_rule ? output.shape_rule : ShapeRule(elementwise);
  output.shape_rule = [rule, n = own_.size()](std::span<const Shape> shapes) {
    return rule(shapes.first(n));
  };
}

void ControlledLeaf::keep_to_own_inputs() {
  for (OutputDeclaration& output : declared_.outputs) {
    output.inputs = own_or(output.inputs);
    keep_to_own_widths(output);
  }
  for (Relation& relation : declared_.relations) relation.inputs = own_or(relation.inputs);
  for (ZeroCrossing& crossing : declared_.zero_crossings) crossing.inputs = own_or(crossing.inputs);
  for (EdgeReset& reset : declared_.edge_resets) reset.inputs = own_or(reset.inputs);
  for (TimeEvent& event : declared_.time_events) event.inputs = own_or(event.inputs);
  for (EventInputDeclaration& input : declared_.event_inputs) input.inputs = own_or(input.inputs);
}

namespace {

/// The formula while the control signal is true, otherwise 0.
Formula zero_unless(const Formula& formula, VectorFunction function, int control, Index size) {
  if (!formula) return {};
  const Formula chosen(std::move(function), [=](Symbols& symbols) {
    std::vector<tape::Symbol> entries = formula.symbols(symbols, size);
    for (tape::Symbol& entry : entries) {
      entry = tape::Symbol::apply(tape::Op::select,
                                  {symbols.input(control, 0), entry, tape::Symbol(0.0)});
    }
    return entries;
  });
  return formula.joins() ? chosen : chosen.called();
}

/// The function while the control signal is true, otherwise 0.
template <class Out>
auto zero_unless(const LeafSystem& system, const Callback<void(const At&, Out)>& function,
                 int control) {
  using Function = Callback<void(const At&, Out)>;
  if (!function) return Function();
  return Function([&system, function, control](const At& at, Out out) {
    if (at.u(control) != 0.0)
      function(system, at, out);
    else
      out.setZero();
  });
}

}  // namespace

bool ControlledLeaf::is_gated(int node) const {
  return std::ranges::find(gated_, node) != gated_.end();
}

/// The control signal of a part inside this one is false while this one is not executed. So the
/// inner part is enabled while both signals are true, and this is what its edges see.
void ControlledLeaf::gate_controls() {
  for (std::size_t i = 0; i < declared_.outputs.size(); ++i) {
    if (!is_gated(leaf_.outputs[i])) continue;
    OutputDeclaration& output = declared_.outputs[i];
    output.calc = zero_unless(system_, output.calc, control_);
    output.formula = zero_unless(output.formula, output.calc, control_, 1);
    output.derivatives = zero_unless(system_, output.derivatives, control_);
    output.inputs =
        with_control(has(output.reads, Reads::inputs) ? output.inputs : std::vector<int>());
    output.reads = output.reads | Reads::inputs;
  }
}

void ControlledLeaf::rest_while_false() {
  ContinuousState& state = declared_.continuous;
  if (!state.ode) return;
  const Index n = state.initial.size();
  const VectorFunction function = zero_unless(system_, state.ode.function, control_);
  const Formula of_ode = zero_unless(state.ode.formula, function, control_, n);
  state.formula = zero_unless(state.formula, function, control_, n);
  state.ode = function;
  state.ode.formula = of_ode;
  state.jacobian = zero_unless(system_, state.jacobian, control_);
  state.sparse_jacobian = zero_unless(system_, state.sparse_jacobian, control_);
  state.derivatives = zero_unless(system_, state.derivatives, control_);
  state.inputs = with_control(has(state.reads, Reads::inputs) ? state.inputs : std::vector<int>());
  state.reads = state.reads | Reads::inputs;
  if (!state.entries) return;
  state.entries = [rule = state.entries, control = control_](Index i, int k,
                                                             std::span<const Index> widths) {
    return k == control ? EntryRange{0, 1} : rule(i, k, widths);
  };
}

ResetMap ControlledLeaf::while_true(const ResetMap& map) const {
  return [&system = system_, map, control = control_](const At& at, Next& next) {
    if (at.u(control) != 0.0) map(system, at, next);
  };
}

/// The states of a part inside this one return to their start where this part is enabled while the signal of the
/// inner one is true: from then on that one is executed again.
EdgeReset ControlledLeaf::reset_behind(const EdgeReset& inner) const {
  EdgeReset reset = inner;
  reset.input = control_;
  reset.inputs->push_back(inner.input);
  reset.reset_map = [&system = system_, map = inner.reset_map, signal = inner.input](const At& at,
                                                                                     Next& next) {
    if (at.u(signal) != 0.0) map(system, at, next);
  };
  return reset;
}

/// An edge of a gated signal is written: where it falls with this part, the part has been executed
/// until then.
void ControlledLeaf::write_while_true() {
  List<EdgeReset> behind;
  for (EdgeReset& reset : declared_.edge_resets) {
    if (is_gated(leaf_.inputs[reset.input])) continue;
    if (reset.before_updates) behind.push_back(reset_behind(reset));
    reset.inputs = with_control(reset.inputs);
    reset.reset_map = while_true(reset.reset_map);
  }
  for (EdgeReset& reset : behind) declared_.edge_resets.push_back(std::move(reset));
  for (TimeEvent& event : declared_.time_events) {
    if (!event.update) continue;
    event.inputs = with_control(event.inputs);
    event.update = while_true(event.update);
  }
}

/// The start values of a run are those of its context. Later the declared ones count.
void ControlledLeaf::reset_when_enabled() {
  const Eigen::VectorXd x = declared_.continuous.initial, z = declared_.discrete;
  if (x.size() + z.size() == 0 && !declared_.has_modes) return;
  declared_.edge_resets.push_back(
      {.name = "enable",
       .input = control_,
       .edge = Edge::rising,
       .reset_map =
           [x, z, mode = declared_.mode, modes = declared_.has_modes](const At&, Next& next) {
             if (x.size() > 0) next.set_continuous_state(x);
             if (z.size() > 0) next.set_discrete_state(z);
             if (modes) next.set_mode(mode);
           },
       .zeno_tolerance = 0.0,  // the part may be enabled as often as its control signal says
       .inputs = std::vector<int>{},
       .before_updates = true});
}

void ControlledLeaf::require_interruptible() const {
  if (!declared_.histories.empty())
    refuse(
        "it keeps a history of its input, which a control signal would interrupt; keep it out of "
        "an EnabledSubsystem or a TriggeredSubsystem");
  for (const ZeroCrossing& crossing : declared_.zero_crossings) {
    if (crossing.is_queued())
      refuse(text("zero crossing '", crossing.name,
                  "' is queued, and its execution could be due while the block is not executed; "
                  "keep the block out of an EnabledSubsystem or a TriggeredSubsystem"));
  }
  for (const TimeEvent& event : declared_.time_events) {
    if (event.next)
      refuse(
          text("the times of event '", event.name,
               "' depend on its updates, which a control signal would skip; keep the block out of "
               "an EnabledSubsystem or a TriggeredSubsystem"));
  }
}

Declarations ControlledLeaf::enabled(bool resets) {
  require_interruptible();
  gate_controls();
  rest_while_false();
  write_while_true();
  if (resets) reset_when_enabled();
  declared_.controls.push_back(control_);
  return std::move(declared_);
}

void ControlledLeaf::require_updates_only() const {
  const std::string where =
      "; a TriggeredSubsystem is executed at its triggers only, so its blocks "
      "have no ";
  if (declared_.continuous.initial.size() > 0)
    refuse(text("it has a continuous state", where,
                "continuous state. An EnabledSubsystem takes the block"));
  for (const ZeroCrossing& crossing : declared_.zero_crossings) {
    if (crossing.direction != Direction::none)
      refuse(text("it has the zero crossing '", crossing.name, "'", where, "guards"));
  }
  for (const EdgeReset& reset : declared_.edge_resets)
    refuse(text("'", reset.name, "' follows an edge", where, "edges of their own"));
  for (const TimeEvent& event : declared_.time_events) {
    if (!event.update || event.inherited) continue;
    const bool periodic = std::isfinite(event.period);
    refuse(text("event '", event.name, "' has ",
                periodic ? "a period of its own" : "times of its own", where,
                "sample times; give the block an inherited sample time, ", inherited_period));
  }
}

Declarations ControlledLeaf::triggered(Edge edge) {
  require_interruptible();
  require_updates_only();
  for (const TimeEvent& event : declared_.time_events) {
    if (!event.inherited) continue;
    declared_.edge_resets.push_back({.name = event.name,
                                     .input = control_,
                                     .edge = edge,
                                     .reset_map = event.update,
                                     .zeno_tolerance = 0.0,  // triggers may accumulate
                                     .inputs = event.inputs});
  }
  std::erase_if(declared_.time_events, [](const TimeEvent& event) { return event.inherited; });
  return std::move(declared_);
}

}  // namespace saltus::detail
