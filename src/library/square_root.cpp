// y = sqrt(u), elementwise.
#include "saltus/library/square_root.hpp"

#include <cmath>

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

SquareRoot::SquareRoot(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [](const auto& at) {
                         using std::sqrt;
                         return sqrt(at.u(0));
                       }});
}

}  // namespace saltus
