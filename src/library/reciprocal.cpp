// y = 1 / u, elementwise.
#include "saltus/library/reciprocal.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Reciprocal::Reciprocal(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [](const auto& at) { return 1.0 / at.u(0); }});
}

}  // namespace saltus
