// y = gain u, elementwise.
#include "saltus/library/gain.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Gain::Gain(std::string name, const Value& gain) : LeafSystem(std::move(name)) {
  const ParameterIndex k = declare_dynamic_parameter("gain", gain.values);
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name(), {gain.shape()}),
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [k](const auto& at) { return at.p(k) * at.u(0); }});
}

}  // namespace saltus
