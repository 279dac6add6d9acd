// The reference of the Brusselator on a square. It has too many unknowns for Radau in 34 digits, and
// is mildly stiff, so an explicit method can follow it: the extrapolated midpoint rule of Gragg,
// Bulirsch and Stoer of order 12 (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential
// Equations I, section II.9) in long double, with equal steps. By hand:
//   g++ -std=gnu++20 -O2 square.cpp -o square && ./square 1e-3 && ./square 5e-4
// Prints u and v along the row of nodes that the scene records, at t = 1.5 and 11.5; the two runs
// show how many digits hold.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using Real = long double;
using Field = std::vector<Real>;
constexpr int n = 32;

void slope(const Field& y, bool source, Field& f) {
  const Real d = Real(n) * n / 10;
  for (int k = 0; k < n * n; ++k) {
    const int i = k % n, j = k / n;
    const std::array<int, 4> near{(i + n - 1) % n + n * j, (i + 1) % n + n * j,
                                  i + n * ((j + n - 1) % n), i + n * ((j + 1) % n)};
    for (int part = 0; part < 2; ++part) {
      Real sum = -4 * y[2 * k + part];
      for (const int other : near) sum += y[2 * other + part];
      f[2 * k + part] = d * sum;
    }
    const Real u = y[2 * k], on = u * u * y[2 * k + 1];
    const int dx = 10 * (i + 1) - 3 * n, dy = 10 * (j + 1) - 6 * n;
    f[2 * k] += 1 + on - Real(22) / 5 * u + (source && dx * dx + dy * dy <= n * n ? 5 : 0);
    f[2 * k + 1] += Real(17) / 5 * u - on;
  }
}

/// Gragg's midpoint rule with m substeps: its error is a series in (step / m)^2.
Field midpoint(const Field& y, bool source, Real step, int m) {
  const Real h = step / m;
  Field before = y, now = y, f(y.size());
  slope(y, source, f);
  for (std::size_t i = 0; i < y.size(); ++i) now[i] += h * f[i];
  for (int k = 1; k < m; ++k) {
    slope(now, source, f);
    for (std::size_t i = 0; i < y.size(); ++i) before[i] += 2 * h * f[i];
    before.swap(now);
  }
  slope(now, source, f);
  for (std::size_t i = 0; i < y.size(); ++i) now[i] = (before[i] + now[i] + h * f[i]) / 2;
  return now;
}

void advance(Field& y, bool source, Real step) {
  const std::array<int, 6> substeps{2, 4, 6, 8, 10, 12};
  std::array<Field, 6> table;
  for (std::size_t k = 0; k < substeps.size(); ++k) {
    table[k] = midpoint(y, source, step, substeps[k]);
    for (std::size_t j = k; j-- > 0;) {  // Aitken, Neville
      const Real ratio = Real(substeps[k]) / substeps[j], weight = ratio * ratio - 1;
      for (std::size_t i = 0; i < y.size(); ++i)
        table[j][i] = table[j + 1][i] + (table[j + 1][i] - table[j][i]) / weight;
    }
  }
  y = table[0];
}

int main(int count, char** words) {
  const Real step = count > 1 ? std::strtold(words[1], nullptr) : 1e-3L;
  Field y(2 * n * n);
  for (int k = 0; k < n * n; ++k) {
    const Real a = Real(k % n + 1) / n, b = Real(k / n + 1) / n;
    y[2 * k] = 22 * b * (1 - b) * std::sqrt(1 - b),
          y[2 * k + 1] = 27 * a * (1 - a) * std::sqrt(1 - a);
  }
  Real t = 0;
  for (const Real end : {1.1L, 1.5L, 11.5L}) {
    const int steps = static_cast<int>(std::ceil((end - t) / step));
    for (int k = 0; k < steps; ++k) advance(y, t > 1, (end - t) / steps);
    t = end;
    std::printf("%.6Lg:", t);
    for (int k = 0; k < 2 * n; ++k) std::printf(" %.20Lg", y[2 * n * 18 + k]);
    std::printf("\n");
    std::fflush(stdout);
  }
}
