// y = u + offset, elementwise.
// in: any width. out: the width of u and offset, one of which may be a scalar. Parameter "offset".
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Offset final : public LeafSystem {
 public:
  Offset(std::string name, const Value& offset) : LeafSystem(std::move(name)) {
    offset_ = declare_dynamic_parameter("offset", offset.values);
    declare_input_port({.name = "in"});
    declare_output_port({.name = "out",
                         .calc = &Offset::shift,
                         .shape = {},
                         .shape_rule = detail::stretch(this->name(), {offset.shape()}),
                         .reads = Reads::inputs,
                         .entries = entry_by_entry});
  }

 private:
  void shift(const At& at, VectorRef out) const {
    const VectorView offset = at.parameter(offset_), u = at.u[0];
    for (Index i = 0; i < out.size(); ++i) out[i] = detail::entry(u, i) + detail::entry(offset, i);
  }

  ParameterIndex offset_;
};

}  // namespace saltus
