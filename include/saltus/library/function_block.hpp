// y = f(u), elementwise: any C++ callable from a number to a number or a bool.
// in: any width. out: the same width. If f returns bool, out is boolean and opaque, as in a
// ReduceBlock. A Formula over u(0) in place of f is fused with its neighbours.
#pragma once

#include "saltus/library/detail/callable.hpp"

namespace saltus {

class FunctionBlock final : public LeafSystem {
 public:
  template <std::invocable<double> Function>
  FunctionBlock(std::string name, Function function) : LeafSystem(std::move(name)) {
    using Result = std::invoke_result_t<const Function&, double>;
    declare_input_port({.name = "in"});
    const auto map = [function = std::move(function)](const At& at, VectorRef out) {
      const VectorView u = at.u[0];
      for (Index i = 0; i < out.size(); ++i) out[i] = static_cast<double>(function(u[i]));
    };
    declare_output_port({.name = "out",
                         .calc = map,
                         .shape = {},
                         .shape_rule = elementwise,
                         .reads = Reads::inputs,
                         .boolean = detail::Truth<Result>,
                         .entries = entry_by_entry});
  }

  FunctionBlock(std::string name, Formula formula);
};

}  // namespace saltus
