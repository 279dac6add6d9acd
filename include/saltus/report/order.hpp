// Order: how fast the error falls with shorter steps, as far as the rows of a report show it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace saltus {

/// One run: the number of its steps, and its error.
struct OrderPoint {
  double steps = 0.0;
  double error = 0.0;
};

/// The visible order p of error ~ C (steps)^-p: the slope of the straight line through (log steps,
/// log error), by least squares. Runs with an error no larger than `floor` are left out, because
/// rounding or the reference decides there. Of the other runs the half with more steps counts, at
/// least three, because the leading term of the error shows at short steps. NaN for fewer than
/// three runs: two points on a line show nothing.
///
/// With error control, a method of order p whose estimate has order h^q takes about tol^(-1/q)
/// steps, and its error falls with h^p. So the slope over steps is p for every q.
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
  const double spread = n * sxx - sx * sx;  // zero if all runs took the same steps
  return spread > 1e-6 * sxx ? -(n * sxy - sx * sy) / spread
                             : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace saltus
