// The output of a part of a diagram that is executed as a control signal says.
#include "saltus/library/subsystem_output.hpp"

namespace saltus {

namespace {

constexpr int in = 0, control = 1;  // inputs

}  // namespace

SubsystemOutput::SubsystemOutput(std::string name, const Options& options)
    : LeafSystem(std::move(name)) {
  const Shape shape = options.initial_output.shape();
  declare_discrete_state(options.initial_output.values);
  declare_input_port({.name = "in", .shape = shape});
  declare_input_port({.name = "control", .shape = Shape::scalar()});
  if (options.execution.kind == Execution::Kind::triggered)
    declare_triggered(shape, options.execution.edge);
  else
    declare_enabled(shape, options.execution.resets);
}

/// While control is false, y is the discrete state; with `resets` nothing writes it.
void SubsystemOutput::declare_enabled(const Shape& shape, bool resets) {
  declare_output_port({.name = "out",
                       .shape = shape,
                       .reads = Reads::inputs | Reads::discrete_state,
                       .entries = entry_by_entry,
                       .formula = [](const auto& at, Index i) {
                         return at.choose(at.u(control, 0) != 0.0, at.u(in, i), at.z(i));
                       }});
  if (!resets) hold_at(Edge::falling, "hold", true);
}

void SubsystemOutput::declare_triggered(const Shape& shape, Edge edge) {
  declare_output_port({.name = "out",
                       .shape = shape,
                       .reads = Reads::discrete_state,
                       .view = Place{Space::z, 0, shape.size}});
  hold_at(edge, "trigger", false);
}

/// A falling control signal takes the input before the instant, because the part was executed until
/// then. A trigger executes the part at the instant itself.
void SubsystemOutput::hold_at(Edge edge, std::string event, bool before) {
  declare_edge_reset(
      {.name = std::move(event),
       .input = control,
       .edge = edge,
       .reset_map = [](const At& at, Next& next) { next.set_discrete_state(at.u[in]); },
       .zeno_tolerance = 0.0,  // it has no state that could rest
       .inputs = std::vector{in},
       .reads_before = before});
}

}  // namespace saltus
