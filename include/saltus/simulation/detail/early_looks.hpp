// EarlyLooks: whether some looks at a guard within a short time show how it moves in that time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// The values of a guard at a point, and after these parts of a time. The parts have no pattern: a sine
/// whose period has one would look like a parabola.
struct EarlyLooks {
  static constexpr std::array parts{1.0 / 64.0, 0.13, 0.49, 0.83, 1.0};

  double start = 0.0;
  std::array<double, parts.size()> after = {};

  /// Whether they show the guard:
  ///
  ///     the values after the start                                shown
  ///     equal, as those of a guard that jumps at the start        yes
  ///     nearly on a parabola, which the first of them confirms    yes
  ///     any others                                                no
  bool show() const {
    if (is_constant()) return true;
    const auto [least, greatest] = std::ranges::minmax(after);
    const double range = std::max(greatest, start) - std::min(least, start);
    const double allowed = thresholds::shown_share * range;
    return std::abs(after[0] - start) <= thresholds::turning_ranges * parts[0] * range &&
           std::abs(after[1] - parabola(parts[1])) <= allowed &&
           std::abs(after[3] - parabola(parts[3])) <= allowed;
  }

  /// Whether the guard only rises or only falls, or is constant after the start.
  bool go_one_way() const {
    double least = start * (after[4] < start ? -1.0 : 1.0);
    return std::ranges::all_of(after, [&](double g) {
      const double up = g * (after[4] < start ? -1.0 : 1.0);
      return std::exchange(least, up) <= up;
    });
  }

 private:
  bool is_constant() const {
    return std::ranges::all_of(after, [&](double g) { return g == after[0]; });
  }
  /// At this part of the time: through the start, the third look and the last.
  double parabola(double s) const {
    constexpr double middle = parts[2];
    const double to_middle = after[2] - start, to_end = after[4] - start;
    return start + to_middle * s * (s - 1.0) / (middle * (middle - 1.0)) +
           to_end * s * (s - middle) / (1.0 - middle);
  }
};

}  // namespace saltus
