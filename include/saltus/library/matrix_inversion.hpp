// Y = U^-1, of a square matrix, by LU factorisation with partial pivoting.
// in: the entries of an n x n matrix, row by row. out: those of its inverse.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MatrixInversion final : public LeafSystem {
 public:
  /// `rows` is n. A run ends with a SimulationError where the matrix is singular to working
  /// precision: its reciprocal condition number, estimated in the 1-norm, is below 2.2e-16, or an
  /// entry is not finite.
  MatrixInversion(std::string name, Index rows);
};

}  // namespace saltus
