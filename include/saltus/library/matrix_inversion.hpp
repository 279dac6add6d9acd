// Y = U^-1, of a square matrix, by LU factorisation with partial pivoting.
// in, out: n x n.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MatrixInversion final : public LeafSystem {
 public:
  /// The wire decides n. ShapeMismatchError, when the diagram is built, if it is no square matrix.
  /// A run ends as below.
  explicit MatrixInversion(std::string name);
  /// `rows` is n; the input takes a vector of the n n entries, row by row, too. A run ends with a SimulationError where the matrix is singular to working
  /// precision: its reciprocal condition number, estimated in the 1-norm, is below 2.2e-16, or an
  /// entry is not finite.
  MatrixInversion(std::string name, Index rows);
};

}  // namespace saltus
