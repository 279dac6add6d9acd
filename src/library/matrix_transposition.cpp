// Y = U^T: y_ij = u_ji.
#include "saltus/library/matrix_transposition.hpp"

#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

MatrixTransposition::MatrixTransposition(std::string name, MatrixShape shape)
    : LeafSystem(std::move(name)) {
  detail::require_matrix(this->name(), "shape", shape);
  declare_input_port({.name = "in", .shape = Shape::of(shape.size())});
  const auto from = [=](Index i) { return i % shape.rows * shape.columns + i / shape.rows; };
  declare_output_port(
      {.name = "out",
       .shape = Shape::of(shape.size()),
       .reads = Reads::inputs,
       .entries = [=](Index i, int,
                      std::span<const Index>) { return EntryRange{from(i), from(i) + 1}; },
       .formula = [=](const auto& at, Index i) { return at.u(0, from(i)); }});
}

}  // namespace saltus
