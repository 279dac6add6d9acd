// The reference of the Brusselator on a square. It has too many unknowns for Radau in 34 digits,
// and is mildly stiff, so an explicit method can follow it. By hand:
//   g++ -std=gnu++20 -O2 square.cpp -o square && ./square 2e-3 && ./square 1e-3
// Prints u and v along the row of nodes that the scene records; the two runs show how many digits
// hold. Takes minutes.
#include <cstdlib>

#include "extrapolation.hpp"

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

int main(int count, char** words) {
  const Real longest = count > 1 ? std::strtold(words[1], nullptr) : 1e-3L;
  Field y(2 * n * n);
  for (int k = 0; k < n * n; ++k) {
    const Real a = Real(k % n + 1) / n, b = Real(k / n + 1) / n;
    y[2 * k] = 22 * b * (1 - b) * std::sqrt(1 - b);
    y[2 * k + 1] = 27 * a * (1 - a) * std::sqrt(1 - a);
  }
  Real t = 0;
  for (const Real end : {1.1L, 1.5L, 11.5L}) {
    const bool source = t > 1;
    advance([&](Real, const Field& x, Field& f) { slope(x, source, f); }, t, y, end, longest);
    print(t, &y[2 * n * 18], 2 * n);  // j = 19
  }
}
