// y = |u|, elementwise.
#include "saltus/library/abs.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Abs::Abs(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  const RelationIndex positive =
      declare_relation({.name = "positive",
                        .size = std::nullopt,
                        .reads = Reads::inputs,
                        .formula = [](const auto& at) { return at.u(0); }});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [positive](const auto& at) {
                         return at.choose(at.relation(positive), at.u(0), -at.u(0));
                       }});
}

}  // namespace saltus
