// The point at which a fit ended, as a FitResult with its warnings.
#pragma once

#include "fit_problem.hpp"

namespace saltus {

/// How the best start ended.
struct FitEnded {
  FitPoint point;
  double cost = 0.0;
  SearchStatus status = SearchStatus::converged;
  std::string message = {};
  std::vector<FitStart> starts = {};
  double wall_time = 0.0;  ///< [s]
};

FitResult fit_result(const FitProblem& problem, const FitEnded& ended, const FitOptions& options);

}  // namespace saltus
