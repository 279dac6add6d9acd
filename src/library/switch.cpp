// y = true_value if control is true, otherwise false_value; elementwise.
#include "saltus/library/switch.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Switch::Switch(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const int true_value = declare_input_port({.name = "true_value"});
  const int control = declare_input_port({.name = "control", .shape = Shape::scalar()});
  const int false_value = declare_input_port({.name = "false_value"});
  std::optional<RelationIndex> reached;
  if (options.threshold) {
    const ParameterIndex k = declare_dynamic_parameter("threshold", *options.threshold);
    reached =
        declare_relation({.name = "reached",
                          .true_at_zero = true,
                          .reads = Reads::inputs,
                          .inputs = std::vector{control},
                          .formula = [=](const auto& at) { return at.u(control) - at.p(k); }});
  }
  declare_output_port(
      {.name = "out",
       .shape = {},
       .shape_rule = detail::stretch(this->name()),
       .reads = options.threshold ? Reads::inputs | Reads::relations : Reads::inputs,
       .entries = entry_by_entry,
       .formula = [=](const auto& at) {
         const auto a = at.u(true_value), b = at.u(false_value);
         if (reached) return at.choose(at.relation(*reached, 0), a, b);
         return at.choose(at.u(control) != 0.0, a, b);
       }});
}

}  // namespace saltus
