// The checks of the shapes that blocks of matrices are given, and meet.
#pragma once

#include "saltus/library/detail/arguments.hpp"
#include "saltus/library/matrix_shape.hpp"

namespace saltus::detail {

/// ModelError without a row or a column. `what` is the name of the argument.
inline void require_matrix(const std::string& block, const char* what, const MatrixShape& shape) {
  insist(shape.rows > 0 && shape.columns > 0, block, what, " is ", shape.rows, " x ", shape.columns,
         "; expected at least one row and one column");
}

/// ShapeMismatchError for an input that is no matrix.
inline void require_matrix_signal(const std::string& block, const Shape& found) {
  if (!found.is_matrix())
    throw ShapeMismatchError(text("block '", block, "': expected a matrix, found ", in_words(found),
                                  "; give the block the rows and columns, if the entries of a "
                                  "matrix come row by row"));
}

/// ShapeMismatchError for an input that is a matrix, at a block of vectors.
inline void require_no_matrix(const std::string& block, const Shape& found) {
  if (found.is_matrix())
    throw ShapeMismatchError(text("block '", block, "': expected a vector, found ", in_words(found),
                                  "; a Multiplexer of one input gives the entries of a matrix as a "
                                  "vector, row by row"));
}

}  // namespace saltus::detail
