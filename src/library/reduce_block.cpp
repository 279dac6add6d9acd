// y = f(u_0, u_1, ...): any C++ callable over all inputs.
#include "saltus/library/reduce_block.hpp"

namespace saltus {

ReduceBlock::ReduceBlock(std::string name, int n_inputs, Formula formula, const Options& options)
    : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "input", n_inputs, 1);
  for (int k = 0; k < n_inputs; ++k) declare_input_port();
  declare_output_port({.name = "out",
                       .shape = options.shape,
                       .reads = Reads::inputs,
                       .formula = std::move(formula)});
}

}  // namespace saltus
