// The rows and columns of a matrix, as an argument of a block.
#pragma once

#include "saltus/model/shape.hpp"

namespace saltus {

/// Rows and columns. Entry (i, j) of the matrix is entry i * columns + j of the signal, the order of
/// `ravel` of NumPy.
struct MatrixShape {
  Index rows = 0, columns = 0;

  Index size() const { return rows * columns; }
  Shape shape() const { return Shape::matrix(rows, columns); }
};

}  // namespace saltus
