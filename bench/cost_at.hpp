// The cost of a solver at an achieved error, from runs at some tolerances.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bench {

/// One run: its error, and its cost in any unit; both positive.
struct CostPoint {
  double error, cost;
};

/// The least cost of an error of at most `error`. `points` are in the order of tolerances, loosest
/// first. Each run whose error is small enough counts with its cost. If the run before has a larger
/// error, the cost in between is interpolated: its logarithm is linear in that of the error. The
/// result is infinite if no run has an error that small.
inline double cost_at(double error, const std::vector<CostPoint>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const CostPoint& fine = points[k];
    if (!(fine.error <= error)) continue;
    least = std::min(least, fine.cost);
    if (k == 0 || !std::isfinite(points[k - 1].error) || points[k - 1].error <= error) continue;
    const CostPoint& rough = points[k - 1];
    const double part = std::log(error / rough.error) / std::log(fine.error / rough.error);
    least = std::min(least, rough.cost * std::pow(fine.cost / rough.cost, part));
  }
  return least;
}

}  // namespace bench
