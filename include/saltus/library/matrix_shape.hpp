// The shape of a matrix that travels as a signal: the vector of its entries, row by row.
#pragma once

#include "saltus/base/view.hpp"

namespace saltus {

/// Rows and columns. Entry (i, j) of the matrix is entry i * columns + j of the signal, the order of
/// `ravel` of NumPy.
struct MatrixShape {
  Index rows = 0, columns = 0;

  Index size() const { return rows * columns; }
};

}  // namespace saltus
