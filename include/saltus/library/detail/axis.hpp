// One input of a table: its points, and the cell in which a value lies.
#pragma once

#include <limits>
#include <string_view>

#include "saltus/base/view.hpp"
#include "saltus/library/detail/knots.hpp"

namespace saltus::detail {

/// The points of one input. If y is clipped all points are knots, otherwise only the inner points,
/// because the outer cells are continued.
struct Axis {
  Knots points, knots;
  bool clipped, bounded;

  Axis(const Eigen::VectorXd& at, std::string_view extrapolation)
      : points({at.begin(), at.end()}),
        knots(extrapolation == "clip" ? std::vector<double>(at.begin(), at.end())
                                      : std::vector<double>(at.begin() + 1, at.end() - 1)),
        clipped(extrapolation == "clip"),
        bounded(extrapolation == "error") {}

  /// The line through points `first` and `first + 1`: y = (1 - part) y_first + part y_next.
  struct Place {
    Index first;
    double part;
  };
  Place place(double u, bool even) const {
    const Index piece = knots.held(u, even), last = points.size() - 1;
    if (clipped && piece == 0) return {0, 0.0};
    if (clipped && piece == points.size()) return {last - 1, 1.0};
    const Index first = clipped ? piece - 1 : piece;
    if (bounded && !(u >= points[0] && u <= points[last]))
      return {first, std::numeric_limits<double>::quiet_NaN()};
    return {first, (u - points[first]) / (points[first + 1] - points[first])};
  }
};

}  // namespace saltus::detail
