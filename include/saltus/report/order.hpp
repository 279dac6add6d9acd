// Order: how fast the error falls when steps are shortened, as far as rows of a report show it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace saltus {

/// One run: how many steps it took, and how wrong it was.
struct OrderPoint {
  double steps = 0.0;
  double error = 0.0;
};

/// The visible order p of error ~ C (steps)^-p: the slope of the straight line through (log steps,
/// log error), by least squares. Runs are left out whose error is no larger than `floor`, where
/// rounding, or the reference, decides; of the others the half with more steps counts, three at
/// least, for the leading term of the error shows where steps are short. NaN for fewer than three
/// runs: two points on a line show nothing.
///
/// With error control a method of order p whose estimate is of order h^q takes about tol^(-1/q)
/// steps, and its error falls with h^p: so the slope over steps is p, whatever q is.
inline double visible_order(std::vector<OrderPoint> runs, double floor) {
  std::erase_if(runs,
                [=](const OrderPoint& run) { return !(run.error > floor && run.steps > 0.0); });
  if (runs.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(runs, std::ranges::greater(), &OrderPoint::steps);
  runs.resize(std::max<std::size_t>(3, (runs.size() + 1) / 2));
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const OrderPoint& run : runs) {
    const double x = std::log(run.steps), y = std::log(run.error);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<double>(runs.size());
  const double spread = n * sxx - sx * sx;  // zero where all took the same steps
  return spread > 1e-6 * sxx ? -(n * sxy - sx * sy) / spread
                             : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace saltus
