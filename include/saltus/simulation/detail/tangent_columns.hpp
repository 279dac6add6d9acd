// TangentColumns: the derivatives by the chosen parameters, and what differences need to know.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/base/view.hpp"

namespace saltus {

/// How the values of a machine change with one parameter.
struct TangentDirection {
  double t = 0.0;                                         ///< of the time
  const double *x = nullptr, *z = nullptr, *y = nullptr;  ///< null: zero
  Index parameter = -1;                                   ///< an entry of p that changes by 1
};

/// The derivatives by the chosen parameters: a column for each of them. They are those at a time that
/// moves by `t`: zero for a fixed time, dtau for the instant at tau, or for a fixed time after it.
struct TangentColumns {
  Eigen::MatrixXd x, z, y;  ///< of the states, the discrete states and the signals
  Eigen::RowVectorXd t;
  std::vector<Index> parameters;  ///< the entry of p that each column is of, or -1
  Index size() const { return static_cast<Index>(parameters.size()); }
  /// Whether a parameter may move the state, or the flow at the state.
  bool matters(Index k) const {
    return nth(parameters, k) >= 0 || !x.col(k).isZero(0.0) || !z.col(k).isZero(0.0) ||
           !y.col(k).isZero(0.0);
  }
  /// One of them as a direction.
  TangentDirection column(Index k) const {
    return {t[k], x.col(k).data(), z.col(k).data(), y.col(k).data(), nth(parameters, k)};
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
