// y = |u|, elementwise.
// in: any width. out: the same width. If y reaches a derivative, u = 0 is located and the side is
// held between instants: the solver sees +u or -u, never the kink.
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Abs final : public LeafSystem {
 public:
  explicit Abs(std::string name) : LeafSystem(std::move(name)) {
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
};

}  // namespace saltus
