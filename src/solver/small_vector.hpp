// Vector operations for small systems, one set for each length. A call of SUNDIALS' serial vectors
// passes through two tables and a general loop, which costs more than the arithmetic for a few
// states. The data layout is that of the serial vector.
#pragma once

#include <cmath>
#include <utility>

#include "sundials_compat.hpp"

#include "saltus/solver/detail/fixed_length.hpp"

namespace saltus::sun {

inline double* data(N_Vector v) { return static_cast<N_VectorContent_Serial>(v->content)->data; }

/// The operations on vectors of length n. The compiler knows n and unrolls the loops.
template <int n>
struct Small {
  static void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
    const double *p = data(x), *q = data(y);
    double* out = data(z);
    for (int i = 0; i < n; ++i) out[i] = a * p[i] + b * q[i];
  }
  /// z[i] = f(x[i])
  template <class F>
  static void map(N_Vector x, N_Vector z, F f) {
    const double* p = data(x);
    double* out = data(z);
    for (int i = 0; i < n; ++i) out[i] = f(p[i]);
  }
  static void scale(double c, N_Vector x, N_Vector z) {
    map(x, z, [c](double value) { return c * value; });
  }
  static void constant(double c, N_Vector z) {
    map(z, z, [c](double) { return c; });
  }
  static void absolute(N_Vector x, N_Vector z) {
    map(x, z, [](double value) { return std::abs(value); });
  }
  static void add_constant(N_Vector x, double b, N_Vector z) {
    map(x, z, [b](double value) { return value + b; });
  }
  static void inverse(N_Vector x, N_Vector z) {
    map(x, z, [](double value) { return 1.0 / value; });
  }

  /// sqrt(sum (x w)^2 / n)
  static double weighted_rms(N_Vector x, N_Vector w) {
    const double *p = data(x), *q = data(w);
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += p[i] * q[i] * p[i] * q[i];
    return std::sqrt(sum / n);
  }

  /// z = sum_j c[j] x_j
  static int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
    double sum[n];
    const double* first = data(x[0]);
    for (int i = 0; i < n; ++i) sum[i] = c[0] * first[i];
    for (int j = 1; j < count; ++j) {
      const double* p = data(x[j]);
      for (int i = 0; i < n; ++i) sum[i] += c[j] * p[i];
    }
    double* out = data(z);
    for (int i = 0; i < n; ++i) out[i] = sum[i];
    return 0;
  }

  /// z_j = a[j] x + y_j
  static int scale_add_multi(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
    for (int j = 0; j < count; ++j) linear_sum(a[j], x, 1.0, y[j], z[j]);
    return 0;
  }

  static void put_into(N_Vector v) {
    v->ops->nvlinearsum = linear_sum, v->ops->nvscale = scale, v->ops->nvconst = constant;
    v->ops->nvabs = absolute, v->ops->nvaddconst = add_constant, v->ops->nvinv = inverse;
    v->ops->nvwrmsnorm = weighted_rms;
    v->ops->nvlinearcombination = linear_combination;
    v->ops->nvscaleaddmulti = scale_add_multi;
  }
};

/// Gives a vector these operations; its clones inherit them.
inline void use_small_operations(N_Vector v) {
  const auto n = N_VGetLength(v);
  if (!has_fixed_length(n)) return;
  [n, v]<int... i>(std::integer_sequence<int, i...>) {
    (void)((n == i + 1 && (Small<i + 1>::put_into(v), true)) || ...);
  }(std::make_integer_sequence<int, thresholds::small_vector>());
}

}  // namespace saltus::sun
