// y = -1 for u < 0, 0 for u = 0, 1 for u > 0, elementwise.
#include "saltus/library/sign.hpp"

namespace saltus {

Sign::Sign(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  const auto side = [this](const char* relation, double sign) {
    return declare_relation({.name = relation,
                             .size = std::nullopt,
                             .reads = Reads::inputs,
                             .formula = [sign](const auto& at) { return sign * at.u(0); }});
  };
  const RelationIndex positive = side("positive", 1.0), negative = side("negative", -1.0);
  declare_output_port(
      {.name = "out",
       .shape = {},
       .shape_rule = elementwise,
       .reads = Reads::relations,
       .entries = entry_by_entry,
       .formula = [=](const auto& at) { return at.relation(positive) - at.relation(negative); }});
}

}  // namespace saltus
