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
    const double left = (g[1] - g[0]) / (u[1] - u[0]), right = (g[2] - g[1]) / (u[2] - u[1]);
    const double bend = (right - left) / (u[2] - u[0]);
    const double slope = left + bend * (u[1] - u[0]);
    if (!(bend > 0.0) || g[1] - slope / (4.0 * bend) * slope > highest) return nowhere;
    const double at = u[1] - slope / (2.0 * bend);
    return at == u[0] || at == u[1] || at == u[2] ? nowhere : at;
  }
  /// A new look replaces an outer one.
  void replace(double at, double value) {
    const bool behind = at > u[1], lower = value < g[1];
    const int out = behind == lower ? 0 : 2;  // the outer look that is not next to the lowest
    const double inner = u[1], inner_g = g[1];
    u[out] = lower ? inner : at, g[out] = lower ? inner_g : value;
    if (lower) u[1] = at, g[1] = value;
  }
};

}  // namespace saltus
