// Y = U^T, of a matrix.
// in: m x n. out: n x m.
#pragma once

#include "saltus/library/matrix_shape.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MatrixTransposition final : public LeafSystem {
 public:
  /// The wire decides the shape. ShapeMismatchError, when the diagram is built, if it is no matrix.
  explicit MatrixTransposition(std::string name);
  /// The input takes a matrix of this shape, or a vector of its entries row by row.
  MatrixTransposition(std::string name, MatrixShape shape);
};

}  // namespace saltus
