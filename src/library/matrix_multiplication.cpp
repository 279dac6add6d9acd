// Y = U_0 U_1: y_ij is the sum of a_il b_lj over l.
#include "saltus/library/matrix_multiplication.hpp"

#include <algorithm>

#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

namespace {

/// The rule of NumPy: a vector on the left is a row, on the right a column, and its dimension does
/// not remain.
Shape product(const std::string& block, const Shape& left, const Shape& right) {
  const Index inner = left.is_matrix() ? left.columns : left.size;
  if (!left.vector || !right.vector || inner != right.rows())
    throw ShapeMismatchError(text("block '", block, "': expected matrices or vectors, as many ",
                                  "columns on the left as rows on the right, found ",
                                  in_words(left), " and ", in_words(right),
                                  left.vector && right.vector ? ""
                                                              : "; a Gain or a Product "
                                                                "multiplies by a scalar"));
  if (left.is_matrix() && right.is_matrix()) return Shape::matrix(left.rows(), right.columns);
  if (left.is_matrix()) return Shape::of(left.rows());
  return right.is_matrix() ? Shape::of(right.columns) : Shape::scalar();
}

/// Entry i of the product of matrices with `inner` columns on the left and `columns` on the right.
auto entry(const auto& at, Index i, Index inner, Index columns) {
  const Index row = i / columns * inner, column = i % columns;
  auto sum = at.u(0, row) * at.u(1, column);
  for (Index l = 1; l < inner; ++l) sum += at.u(0, row + l) * at.u(1, l * columns + column);
  return sum;
}

}  // namespace

MatrixMultiplication::MatrixMultiplication(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port();
  declare_input_port();
  declare_output_port(
      {.name = "out",
       .shape = {},
       .shape_rule = [block = this->name()](
                         std::span<const Shape> in) { return product(block, in[0], in[1]); },
       .reads = Reads::inputs,
       .formula =
           [](const auto& at, Index i) {
             const Index left = at.columns(0);
             return entry(at, i, left > 0 ? left : at.width(0), std::max(at.columns(1), Index{1}));
           }});
}

MatrixMultiplication::MatrixMultiplication(std::string name, MatrixShape left, MatrixShape right)
    : LeafSystem(std::move(name)) {
  detail::require_matrix(this->name(), "left", left);
  detail::require_matrix(this->name(), "right", right);
  detail::insist(left.columns == right.rows, this->name(), "left is ", left.rows, " x ",
                 left.columns, " and right is ", right.rows, " x ", right.columns,
                 "; expected as many columns of left as rows of right");
  declare_input_port({.shape = left.shape(), .flat = true});
  declare_input_port({.shape = right.shape(), .flat = true});
  const Index inner = left.columns, columns = right.columns;
  declare_output_port(
      {.name = "out",
       .shape = Shape::matrix(left.rows, columns),
       .reads = Reads::inputs,
       .entries =
           [=](Index i, int input, std::span<const Index> widths) {
             const Index first = i / columns * inner;
             return input == 0 ? EntryRange{first, first + inner} : EntryRange{0, widths[1]};
           },
       .formula = [=](const auto& at, Index i) { return entry(at, i, inner, columns); }});
}

}  // namespace saltus
