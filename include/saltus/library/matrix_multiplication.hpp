// Y = U_0 U_1, of two matrices.
// in_0: the entries of an m x k matrix, row by row. in_1: those of a k x n matrix. out: those of an
// m x n matrix.
#pragma once

#include "saltus/library/matrix_shape.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MatrixMultiplication final : public LeafSystem {
 public:
  /// ModelError if the columns of `left` are not as many as the rows of `right`.
  MatrixMultiplication(std::string name, MatrixShape left, MatrixShape right);
};

}  // namespace saltus
