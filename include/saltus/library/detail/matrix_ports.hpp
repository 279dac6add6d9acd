// Ports whose signals are the entries of a matrix, row by row.
#pragma once

#include "saltus/library/detail/arguments.hpp"
#include "saltus/library/matrix_shape.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus::detail {

inline void require_matrix(const std::string& block, const char* what, const MatrixShape& shape) {
  insist(shape.rows > 0 && shape.columns > 0, block, what, " is ", shape.rows, " x ", shape.columns,
         "; expected at least one row and one column");
}

}  // namespace saltus::detail
