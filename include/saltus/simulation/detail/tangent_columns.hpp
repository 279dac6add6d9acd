// TangentColumns: the derivatives by the chosen parameters, and what differences need to know.
#pragma once

#include <memory>
#include <span>

#include <Eigen/Core>

#include "saltus/base/view.hpp"
#include "saltus/simulation/detail/parameter_moves.hpp"

namespace saltus {

/// How the values of a machine change with one parameter.
struct TangentDirection {
  double t = 0.0;                                         ///< of the time
  const double *x = nullptr, *z = nullptr, *y = nullptr;  ///< null: zero
  std::span<const ParameterMove> p = {};                  ///< the entries of p that change
};

/// The derivatives by the chosen parameters: a column for each of them. They are those at a time that
/// moves by `t`: zero for a fixed time, dtau for the instant at tau, or for a fixed time after it.
struct TangentColumns {
  Eigen::MatrixXd x, z, y;  ///< of the states, the discrete states and the signals
  Eigen::RowVectorXd t;
  std::shared_ptr<const ParameterMoves> p;  ///< of the parameters of blocks; null: none moves
  Index size() const { return t.size(); }
  /// Whether a parameter may move the state, or the flow at the state.
  bool matters(Index k) const {
    return !moves(k).empty() || !x.col(k).isZero(0.0) || !z.col(k).isZero(0.0) ||
           !y.col(k).isZero(0.0);
  }
  /// The entries of p that a column moves.
  std::span<const ParameterMove> moves(Index k) const {
    if (!p) return {};
    return p->of_column(k);
  }
  /// The columns that move an entry of p.
  std::span<const ParameterMoves::Column> by_entry(Index i) const {
    if (!p) return {};
    return p->of_entry(i);
  }
  /// One of them as a direction.
  TangentDirection column(Index k) const {
    return {t[k], x.col(k).data(), z.col(k).data(), y.col(k).data(), moves(k)};
  }
};

/// The largest of each value of a run so far, and its longest step [s]. The shifts of differences
/// follow them.
struct TangentSizes {
  Eigen::VectorXd x, z, y;
  double step = 0.0;
  bool operator==(const TangentSizes&) const = default;
};

}  // namespace saltus
