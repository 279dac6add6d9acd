// The midpoint rule of Gragg, Bulirsch and Stoer, extrapolated to order 12, in long double with
// equal steps. It is an explicit method, so it confirms what Radau has found by other means. It
// suits equations that oscillate or are hardly stiff.
// E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, section II.9.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

using Real = long double;
using Field = std::vector<Real>;

/// One step of m substeps: its error is a series in (step / m)^2.
template <class Slope>
Field midpoint(const Slope& slope, Real t, const Field& y, Real step, int m) {
  const Real h = step / m;
  Field before = y, now = y, f(y.size());
  slope(t, y, f);
  for (std::size_t i = 0; i < y.size(); ++i) now[i] += h * f[i];
  for (int k = 1; k < m; ++k) {
    slope(t + k * h, now, f);
    for (std::size_t i = 0; i < y.size(); ++i) before[i] += 2 * h * f[i];
    before.swap(now);
  }
  slope(t + step, now, f);
  for (std::size_t i = 0; i < y.size(); ++i) now[i] = (before[i] + now[i] + h * f[i]) / 2;
  return now;
}

/// From t to `end`, in equal steps of at most `longest`; the last stage is at `end` itself.
template <class Slope>
void advance(const Slope& slope, Real& t, Field& y, Real end, Real longest) {
  constexpr std::array<int, 6> substeps{2, 4, 6, 8, 10, 12};
  const int steps = static_cast<int>(std::ceil((end - t) / longest));
  const Real begin = t, step = (end - t) / steps;
  std::array<Field, 6> table;
  for (int n = 0; n < steps; ++n) {
    for (std::size_t k = 0; k < substeps.size(); ++k) {
      table[k] = midpoint(slope, begin + n * step, y, step, substeps[k]);
      for (std::size_t j = k; j-- > 0;) {  // Aitken, Neville
        const Real ratio = Real(substeps[k]) / substeps[j], weight = ratio * ratio - 1;
        for (std::size_t i = 0; i < y.size(); ++i)
          table[j][i] = table[j + 1][i] + (table[j + 1][i] - table[j][i]) / weight;
      }
    }
    y = table[0];
  }
  t = end;
}

/// "t: y y y ..." with 20 digits, as the references of Radau are printed.
inline void print(Real t, const Real* y, std::size_t count) {
  std::printf("%.9Lg:", t);
  for (std::size_t i = 0; i < count; ++i) std::printf(" %.20Lg", y[i]);
  std::printf("\n");
  std::fflush(stdout);
}
