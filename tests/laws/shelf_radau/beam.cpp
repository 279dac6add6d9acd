// The beam by an explicit method, to compare with Radau: nothing is damped, so that equal steps far
// below the period of the fastest mode, 1e-3, follow all of them. By hand:
//   g++ -std=gnu++20 -O2 beam.cpp -o beam && ./beam 2e-4 && ./beam 1e-4
// Takes minutes.
#include <cstdlib>
#include <numbers>

#include "extrapolation.hpp"

constexpr std::size_t n = 40;
constexpr Real n2 = n * n;

/// x = C^-1 x for C with 1, 2, ..., 2, 3 on the diagonal and -c beside it.
void solve(const Field& c, Field diagonal, Field& x) {
  for (std::size_t l = 1; l < n; ++l) {
    const Real q = c[l] / diagonal[l - 1];
    diagonal[l] -= q * c[l], x[l] += q * x[l - 1];
  }
  for (std::size_t l = n; l-- > 0;) {
    if (l < n - 1) x[l] += c[l + 1] * x[l + 1];
    x[l] /= diagonal[l];
  }
}

void slope(const Field& y, Real force, Field& f) {
  Field v(n), w(n), c(n), s(n), diagonal(n, 2);
  diagonal[0] = 1, diagonal[n - 1] = 3;
  for (std::size_t l = 0; l < n; ++l) {
    const Real before = l > 0 ? y[l - 1] : -y[0], after = l < n - 1 ? y[l + 1] : y[n - 1];
    v[l] = n2 * n2 * (before - 2 * y[l] + after) + n2 * force * (std::cos(y[l]) + std::sin(y[l]));
    if (l > 0) c[l] = std::cos(y[l] - y[l - 1]), s[l] = std::sin(y[l] - y[l - 1]);
  }
  const auto turned = [&](const Field& x, std::size_t l) {
    return (l < n - 1 ? s[l + 1] * x[l + 1] : 0) - (l > 0 ? s[l] * x[l - 1] : 0);
  };
  for (std::size_t l = 0; l < n; ++l) w[l] = y[n + l] * y[n + l] + turned(v, l);
  solve(c, diagonal, w);
  for (std::size_t l = 0; l < n; ++l) {
    f[l] = y[n + l];
    f[n + l] = diagonal[l] * v[l] + turned(w, l);
    if (l > 0) f[n + l] -= c[l] * v[l - 1];
    if (l < n - 1) f[n + l] -= c[l + 1] * v[l + 1];
  }
}

int main(int count, char** words) {
  const Real longest = count > 1 ? std::strtold(words[1], nullptr) : 1e-4L,
             pi = std::numbers::pi_v<Real>;
  Field y(2 * n);
  Real t = 0;
  for (const Real end : {2.5L, pi, 5.0L}) {
    const bool pushed = t < 3;
    const auto rate = [&](Real time, const Field& x, Field& f) {
      const Real sine = std::sin(time);
      slope(x, pushed ? 1.5L * sine * sine : 0, f);
    };
    advance(rate, t, y, end, longest);
    print(t, y.data(), 2 * n);
  }
}
