// The sine of time, with a phase that puts no crossing at the start.
#pragma once

#include <cmath>
#include <vector>

namespace support {

/// The times [s] in (0, end] at which sin(w t + 0.4) is the level, for up to 300 turns.
inline std::vector<double> sine_crossings(double frequency, double level, double end) {
  const double pi = std::acos(-1.0), first = std::asin(level);
  std::vector<double> times;
  for (int k = -1; k < 300; ++k) {
    for (const double angle : {first, pi - first}) {
      const double t = (angle + 2.0 * pi * k - 0.4) / frequency;
      if (t > 0.0 && t <= end) times.push_back(t);
    }
  }
  return times;
}

}  // namespace support
