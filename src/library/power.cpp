// y = u^exponent, elementwise.
#include "saltus/library/power.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/operations.hpp"

namespace saltus {

Power::Power(std::string name, const Value& exponent) : LeafSystem(std::move(name)) {
  const ParameterIndex k = declare_dynamic_parameter("exponent", exponent.values);
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name(), {exponent.shape()}),
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [k](const auto& at) {
                         return detail::operation(tape::Op::pow, at.u(0), at.p(k));
                       }});
}

}  // namespace saltus
