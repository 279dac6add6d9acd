// y = u_0 . u_1 = u_0[0] u_1[0] + u_0[1] u_1[1] + ...
#include "saltus/library/dot_product.hpp"

#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

DotProduct::DotProduct(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port();
  declare_input_port();
  const auto number = [block = this->name()](std::span<const Shape> inputs) {
    for (const Shape& shape : inputs) detail::require_no_matrix(block, shape);
    const Index a = inputs[0].size, b = inputs[1].size;
    detail::insist(a == b, block, "the inputs have the widths ", a, " and ", b,
                   "; expected two vectors of one width");
    return Shape::scalar();
  };
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = number,
                       .reads = Reads::inputs,
                       .formula = [](const auto& at, Index) {
                         auto sum = at.u(0, 0) * at.u(1, 0);
                         for (Index i = 1; i < at.width(0); ++i) sum += at.u(0, i) * at.u(1, i);
                         return sum;
                       }});
}

}  // namespace saltus
