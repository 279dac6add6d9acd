// Y = U_0 U_1, of two matrices.
// in_0: m x k. in_1: k x n. out: m x n. A vector of k entries may stand in the place of either: on
// the left it is a row, on the right a column, and out is a vector, of two vectors a scalar.
#pragma once

#include "saltus/library/matrix_shape.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MatrixMultiplication final : public LeafSystem {
 public:
  /// The wires decide the shapes. ShapeMismatchError, when the diagram is built, if the columns of
  /// U_0 are not as many as the rows of U_1, or an input is a scalar.
  explicit MatrixMultiplication(std::string name);
  /// Each input takes a matrix of its shape, or a vector of its entries row by row. ModelError if the columns of `left` are not as many as the rows of `right`.
  MatrixMultiplication(std::string name, MatrixShape left, MatrixShape right);
};

}  // namespace saltus
