// Y = U^T, of a matrix.
// in: the entries of an m x n matrix, row by row. out: those of an n x m matrix.
#pragma once

#include "saltus/library/matrix_shape.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MatrixTransposition final : public LeafSystem {
 public:
  MatrixTransposition(std::string name, MatrixShape shape);
};

}  // namespace saltus
