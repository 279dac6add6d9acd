// y = true while u > 0.
#include "saltus/library/control_port.hpp"

namespace saltus {

ControlPort::ControlPort(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  const RelationIndex positive =
      declare_relation({.name = "positive",
                        .true_at_zero = false,
                        .reads = Reads::inputs,
                        .formula = [](const auto& at, Index) { return at.u(0, 0); }});
  declare_output_port({.name = "out",
                       .reads = Reads::relations,
                       .boolean = true,
                       .controls_only = true,
                       .formula = [=](const auto& at) { return at.relation(positive); }});
}

}  // namespace saltus
