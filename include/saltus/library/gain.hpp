// y = gain u, elementwise.
// in: any width. out: the width of u and gain, one of which may be a scalar. Parameter "gain".
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Gain final : public LeafSystem {
 public:
  Gain(std::string name, const Value& gain) : LeafSystem(std::move(name)) {
    const ParameterIndex k = declare_dynamic_parameter("gain", gain.values);
    declare_input_port({.name = "in"});
    declare_output_port({.name = "out",
                         .shape = {},
                         .shape_rule = detail::stretch(this->name(), {gain.shape()}),
                         .reads = Reads::inputs,
                         .entries = entry_by_entry,
                         .formula = [k](const auto& at) { return at.p(k) * at.u(0); }});
  }
};

}  // namespace saltus
