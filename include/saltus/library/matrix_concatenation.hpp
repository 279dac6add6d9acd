// Y = (U_0; U_1; ...), one below the other, or (U_0 U_1 ...), one beside the other.
// in_0, in_1, ...: matrices of as many columns, or rows. A vector is a row below others, and a column
// beside others; a scalar is 1 x 1. out: a matrix.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MatrixConcatenation final : public LeafSystem {
 public:
  /// Along axis 0 the rows of all inputs follow each other, along axis 1 their columns. ModelError
  /// for another axis; ShapeMismatchError, when the diagram is built, for inputs that do not fit.
  MatrixConcatenation(std::string name, int n_inputs, int axis = 0);
};

}  // namespace saltus
