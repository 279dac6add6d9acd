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
/// first. A run that is exact enough counts with its own cost. Between a run that is not and the
/// next one that is, the cost is a straight line in the logarithms of both. Infinite if no run is
/// exact enough. The cost of a loose run that is exact enough is an upper bound, and counts too.
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
