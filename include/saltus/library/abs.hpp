// y = |u|, elementwise.
// in: any width. out: the same. Where y reaches a derivative, u = 0 is located and the side held
// between instants: the solver sees +u or -u, never the kink.
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Abs final : public LeafSystem {
 public:
  explicit Abs(std::string name) : LeafSystem(std::move(name)) {
    declare_input_port({.name = "in"});
    positive_ = declare_relation({.name = "positive",
                                  .guard = [](const At& at, VectorRef g) { g = at.u[0]; },
                                  .size = std::nullopt,
                                  .reads = Reads::inputs});
    declare_output_port({.name = "out",
                         .calc = &Abs::magnitude,
                         .shape = {},
                         .shape_rule = elementwise,
                         .reads = Reads::inputs | Reads::relations,
                         .entries = entry_by_entry});
  }

 private:
  void magnitude(const At& at, VectorRef out) const {
    const VectorView u = at.u[0];
    for (Index i = 0; i < out.size(); ++i) out[i] = at.relation(positive_, i) ? u[i] : -u[i];
  }

  RelationIndex positive_;
};

}  // namespace saltus
