// Y = U^T: y_ij = u_ji.
#include "saltus/library/matrix_transposition.hpp"

#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

namespace {

/// The place in a matrix of `columns` and `rows` of entry i of its transpose.
Index place(Index i, Index rows, Index columns) { return i % rows * columns + i / rows; }

}  // namespace

MatrixTransposition::MatrixTransposition(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule =
                           [block = this->name()](std::span<const Shape> in) {
                             detail::require_matrix_signal(block, in[0]);
                             return Shape::matrix(in[0].columns, in[0].rows());
                           },
                       .reads = Reads::inputs,
                       .formula =
                           [](const auto& at, Index i) {
                             const Index columns = at.columns(0);
                             return at.u(0, place(i, at.width(0) / columns, columns));
                           }});
}

MatrixTransposition::MatrixTransposition(std::string name, MatrixShape shape)
    : LeafSystem(std::move(name)) {
  detail::require_matrix(this->name(), "shape", shape);
  declare_input_port({.name = "in", .shape = shape.shape(), .flat = true});
  const auto from = [=](Index i) { return place(i, shape.rows, shape.columns); };
  declare_output_port(
      {.name = "out",
       .shape = Shape::matrix(shape.columns, shape.rows),
       .reads = Reads::inputs,
       .entries = [=](Index i, int,
                      std::span<const Index>) { return EntryRange{from(i), from(i) + 1}; },
       .formula = [=](const auto& at, Index i) { return at.u(0, from(i)); }});
}

}  // namespace saltus
