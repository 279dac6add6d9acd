// The check of the shapes that blocks of matrices are given.
#pragma once

#include "saltus/library/detail/arguments.hpp"
#include "saltus/library/matrix_shape.hpp"

namespace saltus::detail {

/// ModelError without a row or a column. `what` is the name of the argument.
inline void require_matrix(const std::string& block, const char* what, const MatrixShape& shape) {
  insist(shape.rows > 0 && shape.columns > 0, block, what, " is ", shape.rows, " x ", shape.columns,
         "; expected at least one row and one column");
}

}  // namespace saltus::detail
