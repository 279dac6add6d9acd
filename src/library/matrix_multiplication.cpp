// Y = U_0 U_1: y_ij is the sum of a_il b_lj over l.
#include "saltus/library/matrix_multiplication.hpp"

#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

MatrixMultiplication::MatrixMultiplication(std::string name, MatrixShape left, MatrixShape right)
    : LeafSystem(std::move(name)) {
  detail::require_matrix(this->name(), "left", left);
  detail::require_matrix(this->name(), "right", right);
  detail::insist(left.columns == right.rows, this->name(), "left is ", left.rows, " x ",
                 left.columns, " and right is ", right.rows, " x ", right.columns,
                 "; expected as many columns of left as rows of right");
  declare_input_port({.shape = Shape::of(left.size())});
  declare_input_port({.shape = Shape::of(right.size())});
  const Index inner = left.columns, columns = right.columns;
  declare_output_port({.name = "out",
                       .shape = Shape::of(left.rows * columns),
                       .reads = Reads::inputs,
                       .entries =
                           [=](Index i, int input, std::span<const Index> widths) {
                             const Index first = i / columns * inner;
                             return input == 0 ? EntryRange{first, first + inner}
                                               : EntryRange{0, widths[1]};
                           },
                       .formula =
                           [=](const auto& at, Index i) {
                             const Index row = i / columns * inner, column = i % columns;
                             auto sum = at.u(0, row) * at.u(1, column);
                             for (Index l = 1; l < inner; ++l)
                               sum += at.u(0, row + l) * at.u(1, l * columns + column);
                             return sum;
                           }});
}

}  // namespace saltus
