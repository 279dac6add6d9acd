// dx/dt = A x + B u, y = C x + D u: a linear system with constant coefficients.
// in: scalar if B has one column, otherwise a vector. out: scalar if C has one row, otherwise a
// vector. Parameters "A", "B", "C", "D", each matrix row by row. Without D, or with a D of zeros,
// there is no feedthrough and no parameter "D": the block may close a loop.
#pragma once

#include <optional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct LTISystemMatrices {
  Eigen::MatrixXd A;                      ///< n x n [1/s]
  Eigen::MatrixXd B;                      ///< n x inputs
  Eigen::MatrixXd C;                      ///< outputs x n
  std::optional<Eigen::MatrixXd> D = {};  ///< outputs x inputs
};

struct LTISystemOptions {
  std::optional<Eigen::VectorXd> initial_state = {};  ///< x at the start: n numbers, otherwise 0
};

namespace detail {

/// Throws ModelError if the matrices or the start do not fit one another.
void require_sizes(const std::string& block, const LTISystemMatrices& matrices,
                   const LTISystemOptions& options);

/// The entries of a matrix, row by row.
Eigen::VectorXd by_rows(const Eigen::MatrixXd& matrix);

/// The matrices of a linear system as parameters of its block.
struct LTIParameters {
  ParameterIndex a, b, c;
  std::optional<ParameterIndex> d;  ///< none: no D, or one of zeros

  /// `declare(name, values)` declares a parameter.
  template <class Declare>
  LTIParameters(const LTISystemMatrices& m, const Declare& declare)
      : a(declare("A", by_rows(m.A))),
        b(declare("B", by_rows(m.B))),
        c(declare("C", by_rows(m.C))) {
    if (m.D && !m.D->isZero(0.0)) d = declare("D", by_rows(*m.D));
  }
};

}  // namespace detail

class LTISystem final : public LeafSystem {
 public:
  using Matrices = LTISystemMatrices;
  using Options = LTISystemOptions;

  LTISystem(std::string name, const Matrices& matrices, const Options& options = {});
};

}  // namespace saltus
