// y = gain u, elementwise.
// in: any width. out: the width of u and gain, one of which may be a scalar. Parameter "gain".
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Gain final : public LeafSystem {
 public:
  Gain(std::string name, const Value& gain) : LeafSystem(std::move(name)) {
    gain_ = declare_dynamic_parameter("gain", gain.values);
    declare_input_port({.name = "in"});
    declare_output_port({.name = "out",
                         .calc = &Gain::scale,
                         .shape = {},
                         .shape_rule = detail::stretch(this->name(), {gain.shape()}),
                         .reads = Reads::inputs,
                         .entries = entry_by_entry});
  }

 private:
  void scale(const At& at, VectorRef out) const {
    const VectorView gain = at.parameter(gain_), u = at.u[0];
    for (Index i = 0; i < out.size(); ++i) out[i] = detail::entry(gain, i) * detail::entry(u, i);
  }

  ParameterIndex gain_;
};

}  // namespace saltus
