// y = u[0] + u[1] + ...: the sum of the entries.
#include "saltus/library/sum_of_elements.hpp"

namespace saltus {

SumOfElements::SumOfElements(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = Shape::scalar(),
                       .reads = Reads::inputs,
                       .formula = [](const auto& at, Index) {
                         auto all = at.u(0, 0);
                         for (Index i = 1; i < at.width(0); ++i) all += at.u(0, i);
                         return all;
                       }});
}

}  // namespace saltus
