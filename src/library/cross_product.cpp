// y = u_0 x u_1, of two vectors in space.
#include "saltus/library/cross_product.hpp"

namespace saltus {

CrossProduct::CrossProduct(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.shape = Shape::of(3)});
  declare_input_port({.shape = Shape::of(3)});
  declare_output_port({.name = "out",
                       .shape = Shape::of(3),
                       .reads = Reads::inputs,
                       .formula = [](const auto& at, Index i) {
                         const Index j = (i + 1) % 3, k = (i + 2) % 3;
                         return at.u(0, j) * at.u(1, k) - at.u(0, k) * at.u(1, j);
                       }});
}

}  // namespace saltus
