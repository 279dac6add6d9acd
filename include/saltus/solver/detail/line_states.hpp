// LineStates: the states that move on straight lines in a part of a step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Three points of a step, of which only the states that move on a line differ. With them a guard has three
/// values, which say whether it is a line, too.
class LineStates {
 public:
  /// Finds the states that move on a line from `x`, at `u`, to the points `near` and `far` [s] later. False if
  /// there are none. `interpolate(u, x)` gives the state inside the step.
  template <class Interpolate>
  bool find(const List<double>& x, double u, double near, double far,
            const Interpolate& interpolate) {
    share_ = near / far, rounding_ = 0.0;
    for (auto& point : points_) point.assign(x.size(), 0.0);
    interpolate(u + near, points_[0].data()), interpolate(u + far, points_[1].data());
    bool found = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (is_line(x[i], points_[0][i], points_[1][i]))
        found = true;
      else
        points_[0][i] = points_[1][i] = x[i];
    }
    return found;
  }
  /// The state at the nearer point, 0, and at the farther one, 1.
  const double* at(std::size_t point) const { return points_[point].data(); }

  /// Whether these values of a guard, at the beginning and at both points, are not on a line.
  bool bends(double g0, double g1, double g2) const {
    const double size = std::max({std::abs(g0), std::abs(g1), std::abs(g2)});
    const double rounding = thresholds::line_roundings * thresholds::eps * size;
    return std::abs((g1 - g0) - share_ * (g2 - g0)) > rounding + rounding_ * std::abs(g2 - g0);
  }

 private:
  /// Whether a state with these values moves on a line. Then its rounding, as a part of its move, is noted.
  bool is_line(double x0, double x1, double x2) {
    const double move = x2 - x0;
    const double rounding = thresholds::line_roundings * thresholds::eps *
                            std::max({std::abs(x0), std::abs(x1), std::abs(x2)});
    if (!(std::abs(move) > thresholds::line_moves * rounding) ||
        !(std::abs((x1 - x0) - share_ * move) <= rounding))
      return false;
    rounding_ = std::max(rounding_, rounding / std::abs(move));
    return true;
  }

  std::array<List<double>, 2> points_;
  double share_ = 0.5;     // of the way to the farther point at which the nearer one is
  double rounding_ = 0.0;  // [of a move] by that of the states
};

}  // namespace saltus
