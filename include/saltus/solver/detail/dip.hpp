// Dip: whether a guard crossed zero and came back between three looks on one side.
#pragma once

#include <limits>

namespace saltus {

/// Three looks at one guard, all on its side.
struct Dip {
  static constexpr double nowhere = std::numeric_limits<double>::infinity();
  double u[3], g[3];

  /// The vertex of the parabola through the looks; `nowhere` if it opens downwards or stays above
  /// `highest`.
  double vertex(double highest) const {
    if (!(g[0] > 0.0 && g[1] > 0.0 && g[2] > 0.0)) return nowhere;
    const double left = slope(0), opens = bend();
    const double tilt = left + opens * (u[1] - u[0]);  // the slope at u[1]
    if (!(opens > 0.0) || g[1] - tilt / (4.0 * opens) * tilt > highest) return nowhere;
    const double at = u[1] - tilt / (2.0 * opens);
    return at == u[0] || at == u[1] || at == u[2] ? nowhere : at;
  }
  /// Half of the second derivative of that parabola.
  double bend() const { return (slope(1) - slope(0)) / (u[2] - u[0]); }

 private:
  double slope(int i) const { return (g[i + 1] - g[i]) / (u[i + 1] - u[i]); }
};

}  // namespace saltus
