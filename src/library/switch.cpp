// y = true_value if control is true, otherwise false_value; elementwise.
#include "saltus/library/switch.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/is_not_zero.hpp"

namespace saltus {

Switch::Switch(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const int true_value = declare_input_port({.name = "true_value"});
  const int control = declare_input_port({.name = "control", .shape = Shape::scalar()});
  const int false_value = declare_input_port({.name = "false_value"});
  RelationIndex holds;
  if (options.threshold) {
    const ParameterIndex k = declare_dynamic_parameter("threshold", *options.threshold);
    holds = declare_relation({.name = "reached",
                              .true_at_zero = true,
                              .reads = Reads::inputs,
                              .inputs = std::vector{control},
                              .formula = [=](const auto& at) { return at.u(control) - at.p(k); }});
  } else {
    holds = declare_relation(detail::is_not_zero(control));
  }
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [=](const auto& at) {
                         return at.choose(at.relation(holds, 0), at.u(true_value),
                                          at.u(false_value));
                       }});
}

}  // namespace saltus
