// y = f(u), elementwise: any C++ callable from a number to a number or a bool.
#include "saltus/library/function_block.hpp"

namespace saltus {

FunctionBlock::FunctionBlock(std::string name, Formula formula) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = std::move(formula)});
}

}  // namespace saltus
