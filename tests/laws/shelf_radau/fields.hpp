// The equations of the large scenes in binary128: a beam, a plate, and fields on a grid.
#pragma once

#include <algorithm>

#include "problem.hpp"

/// A tridiagonal matrix with `below` on both sides: solves in place.
inline void solve_symmetric(Vector diagonal, const Vector& below, Vector& right) {
  const std::size_t n = right.size();
  for (std::size_t l = 1; l < n; ++l) {
    const Quad q = below[l] / diagonal[l - 1];
    diagonal[l] -= q * below[l], right[l] -= q * right[l - 1];
  }
  for (std::size_t l = n; l-- > 0;) {
    if (l + 1 < n) right[l] -= below[l + 1] * right[l + 1];
    right[l] /= diagonal[l];
  }
}

/// theta'' = C v + D w with C w = D v + theta'^2, n rods.
inline Equation beam(std::size_t n) {
  return [n](Quad t, const Vector& y, Vector& f) {
    const Quad n2 = Quad(n) * n, n4 = n2 * n2, s = sinq(t),
               force = t < M_PIq ? Quad(3) / 2 * s * s : 0;
    Vector v(n), w(n), c(n), d(n), diagonal(n, 2);
    for (std::size_t l = 0; l < n; ++l) {
      const Quad before = l > 0 ? y[l - 1] : -y[0], after = l + 1 < n ? y[l + 1] : y[n - 1];
      v[l] = n4 * (before - 2 * y[l] + after) + n2 * force * (cosq(y[l]) + sinq(y[l]));
      if (l > 0) c[l] = -cosq(y[l] - y[l - 1]), d[l] = sinq(y[l] - y[l - 1]);
    }
    diagonal[0] = 1, diagonal[n - 1] = 3;
    const auto rows = [&](std::size_t l, const Vector& x, const Vector& below, int sign) {
      return (l > 0 ? sign * below[l] * x[l - 1] : Quad(0)) +
             (l + 1 < n ? below[l + 1] * x[l + 1] : Quad(0));
    };
    for (std::size_t l = 0; l < n; ++l) w[l] = rows(l, v, d, -1) + y[n + l] * y[n + l];
    solve_symmetric(diagonal, c, w);
    for (std::size_t l = 0; l < n; ++l) {
      f[l] = y[n + l];
      f[n + l] = diagonal[l] * v[l] + rows(l, v, c, 1) + rows(l, w, d, -1);
    }
  };
}

/// Nerve cells on a ring: (y, a, b) of each in turn.
inline Equation cusp(std::size_t n) {
  return [n](Quad, const Vector& w, Vector& f) {
    static const Quad lift = number("0.07"), half = number("0.035"), pull = number("0.4");
    const Quad diffusion = Quad(n) * n / 144;
    for (std::size_t i = 0; i < n; ++i) {
      const Quad y = w[3 * i], a = w[3 * i + 1], b = w[3 * i + 2],
                 u = (y - number("0.7")) * (y - number("1.3")), v = u / (u + number("0.1"));
      f[3 * i] = -10000 * (y * y * y + a * y + b);
      f[3 * i + 1] = b + lift * v;
      f[3 * i + 2] = (1 - a * a) * b - a - pull * y + half * v;
      for (std::size_t k = 0; k < 3; ++k)
        f[3 * i + k] += diffusion * (w[3 * ((i + n - 1) % n) + k] - 2 * w[3 * i + k] +
                                     w[3 * ((i + 1) % n) + k]);
    }
  };
}
inline Vector cusp_start(std::size_t n) {
  Vector w(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Quad angle = 2 * M_PIq * (i + 1) / n;
    w[3 * i + 1] = -2 * cosq(angle), w[3 * i + 2] = 2 * sinq(angle);
  }
  return w;
}

/// A Laplacian on 8 by 5 points, 0 around them, applied twice: u, then du/dt.
inline const Equation plate = [](Quad t, const Vector& y, Vector& f) {
  const int nx = 8, ny = 5, n = nx * ny;
  const Quad h = Quad(2) / 9;
  const auto laplacian = [&](const Quad* u, int i, int j) {
    const auto at = [&](int a, int b) {
      return a < 0 || a >= nx || b < 0 || b >= ny ? Quad(0) : u[a + nx * b];
    };
    return (at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1) - 4 * at(i, j)) / (h * h);
  };
  Vector curved(n);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) curved[i + nx * j] = laplacian(y.data(), i, j);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int k = i + nx * j;
      const Quad a = t - (i + 1) * h - 2, b = t - (i + 1) * h - 5;
      const Quad load = j == 1 || j == 3 ? 200 * (expq(-5 * a * a) + expq(-5 * b * b)) : 0;
      f[k] = y[n + k];
      f[n + k] = load - 1000 * y[n + k] - 100 * laplacian(curved.data(), i, j);
    }
};

/// Antibodies into tissue, zeta = x / (x + 4): u and v in turn.
inline Equation medakzo(int n) {
  return [n](Quad t, const Vector& y, Vector& f) {
    for (int j = 0; j < n; ++j) {
      const Quad u = y[2 * j], v = y[2 * j + 1], left = j > 0 ? y[2 * j - 2] : Quad(t <= 5 ? 2 : 0),
                 right = j + 1 < n ? y[2 * j + 2] : u, z = Quad(j + 1) / n - 1,
                 binding = 100 * u * v;
      f[2 * j] = z * z * z / 8 * (right - left) * n / 2 +
                 z * z * z * z / 16 * (left - 2 * u + right) * n * n - binding;
      f[2 * j + 1] = -binding;
    }
  };
}
inline Vector medakzo_start(int n) {
  Vector y(2 * n);
  for (int j = 0; j < n; ++j) y[2 * j + 1] = 1;
  return y;
}
