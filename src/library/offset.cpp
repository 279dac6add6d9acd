// y = u + offset, elementwise.
#include "saltus/library/offset.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Offset::Offset(std::string name, const Value& offset) : LeafSystem(std::move(name)) {
  const ParameterIndex k = declare_dynamic_parameter("offset", offset.values);
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name(), {offset.shape()}),
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [k](const auto& at) { return at.u(0) + at.p(k); }});
}

}  // namespace saltus
