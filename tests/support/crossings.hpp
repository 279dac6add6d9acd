// The crossings of a function of the time, by dense sampling and bisection.
#pragma once

#include <cmath>
#include <vector>

#include "support/cases.hpp"

namespace support {

/// The crossings of g in (0, end), by samples `step` apart, and the least that any extremum is away from zero.
struct Crossings {
  std::vector<double> times;
  double margin = infinite;

  template <class G>
  Crossings(const G& g, double step, double end) {
    double before = g(-step), at = g(0.0);
    for (double t = 0.0; t < end; t += step) {
      const double next = g(t + step);
      if ((at - before) * (next - at) <= 0.0) margin = std::min(margin, std::abs(at));
      if ((at > 0.0) != (next > 0.0)) times.push_back(root(g, t, t + step));
      before = at, at = next;
    }
    while (!times.empty() && times.back() > end) times.pop_back();
  }

 private:
  template <class G>
  static double root(const G& g, double low, double high) {
    const bool above = g(low) > 0.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((g(middle) > 0.0) == above ? low : high) = middle;
    }
    return low;
  }
};

}  // namespace support
