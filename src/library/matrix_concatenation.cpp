// Y = (U_0; U_1; ...) or (U_0 U_1 ...).
#include "saltus/library/matrix_concatenation.hpp"

#include "saltus/library/detail/arguments.hpp"
#include "saltus/library/matrix_shape.hpp"

namespace saltus {

namespace {

/// An input as a matrix: a vector is a row along axis 0, and a column along axis 1.
MatrixShape as_matrix(const Shape& in, int axis) {
  if (in.is_matrix()) return {in.rows(), in.columns};
  return axis == 0 ? MatrixShape{1, in.size} : MatrixShape{in.size, 1};
}

Shape joined(const std::string& block, std::span<const Shape> inputs, int axis) {
  MatrixShape all = as_matrix(inputs[0], axis);
  for (std::size_t k = 1; k < inputs.size(); ++k) {
    const MatrixShape next = as_matrix(inputs[k], axis);
    const bool fits = axis == 0 ? next.columns == all.columns : next.rows == all.rows;
    if (!fits)
      throw ShapeMismatchError(text("block '", block, "': expected as many ",
                                    axis == 0 ? "columns" : "rows", " in all inputs, found ",
                                    in_words(inputs[0]), " at in_0 and ", in_words(inputs[k]),
                                    " at in_", k));
    (axis == 0 ? all.rows : all.columns) += axis == 0 ? next.rows : next.columns;
  }
  return all.shape();
}

/// The columns of input k beside others.
template <class At>
Index columns(const At& at, int k) {
  return at.columns(k) > 0 ? at.columns(k) : 1;
}

/// Entry i of inputs that follow each other.
template <class At>
auto below(const At& at, Index i) {
  int k = 0;
  while (i >= at.width(k)) i -= at.width(k++);
  return at.u(k, i);
}

/// Entry i of inputs that are beside each other.
template <class At>
auto beside(const At& at, Index i, int n_inputs) {
  Index all = 0;
  for (int k = 0; k < n_inputs; ++k) all += columns(at, k);
  Index column = i % all;
  int k = 0;
  while (column >= columns(at, k)) column -= columns(at, k++);
  return at.u(k, i / all * columns(at, k) + column);
}

}  // namespace

MatrixConcatenation::MatrixConcatenation(std::string name, int n_inputs, int axis)
    : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "input", n_inputs, 1);
  detail::insist(
      axis == 0 || axis == 1, this->name(), "axis is ", axis,
      "; expected 0, for inputs one below the other, or 1, for inputs beside each other");
  for (int k = 0; k < n_inputs; ++k) declare_input_port();
  declare_output_port(
      {.name = "out",
       .shape = {},
       .shape_rule = [axis, block = this->name()](
                         std::span<const Shape> in) { return joined(block, in, axis); },
       .reads = Reads::inputs,
       .formula = [=](const auto& at,
                      Index i) { return axis == 0 ? below(at, i) : beside(at, i, n_inputs); }});
}

}  // namespace saltus
