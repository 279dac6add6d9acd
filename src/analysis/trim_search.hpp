// The search for an operating point, and its judgement.
#pragma once

#include "trim_problem.hpp"

namespace saltus {

struct TrimBounds {
  Eigen::VectorXd lower, upper;
  Eigen::VectorXd clipped(const Eigen::VectorXd& values) const {
    return values.cwiseMax(lower).cwiseMin(upper);
  }
};

/// The sizes of unknowns and of residuals.
struct TrimScales {
  /// The unit of each: its size at the start, or the width of its bounds, or 1.
  Eigen::VectorXd unknowns;
  Eigen::VectorXd sizes;  ///< the largest of its values at the start and at the end
  Eigen::VectorXd rows;   ///< |J| times the units; 1 for an equation without unknowns

  Eigen::VectorXd largest() const { return sizes.cwiseMax(unknowns); }
};

/// How a search ended.
struct TrimFound {
  TrimPoint first, point;
  TrimScales scales;
  SearchStatus status = SearchStatus::converged;
};

/// Least squares from a start, and Newton steps to the rounding.
TrimFound search_point(TrimProblem& problem, const Eigen::VectorXd& start, const TrimBounds& bounds,
                       double tolerance, std::optional<int> max_nfev);

/// The result of a search.
OperatingPoint outcome_of(TrimProblem& problem, const TrimFound& found, const TrimBounds& bounds);

}  // namespace saltus
