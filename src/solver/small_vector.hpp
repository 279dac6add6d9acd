// Vector operations written out for small systems. A call of SUNDIALS' serial vectors goes through
// two tables and a general loop; for a few states that costs more than the arithmetic. The content
// stays that of the serial vector.
#pragma once

#include <cmath>

#include "sundials_compat.hpp"

namespace saltus::sun {

/// The operations for N states, or for as many as the vector says with N = 0. Of known size they
/// are straight lines of code: a loop over two numbers costs more than what it does.
template <int N>
struct Small {
  static double* data(N_Vector v) { return static_cast<N_VectorContent_Serial>(v->content)->data; }
  static sunindextype size(N_Vector v) {
    return N > 0 ? N : static_cast<N_VectorContent_Serial>(v->content)->length;
  }

  /// z[i] = f(i)
  template <class F>
  static void fill(N_Vector z, F f) {
    double* out = data(z);
    for (sunindextype i = 0, n = size(z); i < n; ++i) out[i] = f(i);
  }

  static void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
    fill(z, [a, b, p = data(x), q = data(y)](sunindextype i) { return a * p[i] + b * q[i]; });
  }
  static void scale(double c, N_Vector x, N_Vector z) {
    fill(z, [c, p = data(x)](sunindextype i) { return c * p[i]; });
  }
  static void constant(double c, N_Vector z) {
    fill(z, [c](sunindextype) { return c; });
  }
  static void absolute(N_Vector x, N_Vector z) {
    fill(z, [p = data(x)](sunindextype i) { return std::abs(p[i]); });
  }
  static void add_constant(N_Vector x, double b, N_Vector z) {
    fill(z, [b, p = data(x)](sunindextype i) { return p[i] + b; });
  }
  static void inverse(N_Vector x, N_Vector z) {
    fill(z, [p = data(x)](sunindextype i) { return 1.0 / p[i]; });
  }

  /// sqrt(sum (x w)^2 / n)
  static double weighted_rms(N_Vector x, N_Vector w) {
    const double *p = data(x), *q = data(w);
    double sum = 0.0;
    for (sunindextype i = 0, n = size(x); i < n; ++i) sum += (p[i] * q[i]) * (p[i] * q[i]);
    return std::sqrt(sum / static_cast<double>(size(x)));
  }

  /// z = sum_j c[j] x_j
  static int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
    double* out = data(z);
    for (sunindextype i = 0, n = size(z); i < n; ++i) {
      double sum = c[0] * data(x[0])[i];
      for (int j = 1; j < count; ++j) sum += c[j] * data(x[j])[i];
      out[i] = sum;
    }
    return 0;
  }

  /// z_j = a[j] x + y_j
  static int scale_add_multi(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
    for (int j = 0; j < count; ++j) linear_sum(a[j], x, 1.0, y[j], z[j]);
    return 0;
  }

  static void put_into(N_Vector v) {
    v->ops->nvlinearsum = linear_sum;
    v->ops->nvscale = scale;
    v->ops->nvconst = constant;
    v->ops->nvabs = absolute;
    v->ops->nvaddconst = add_constant;
    v->ops->nvinv = inverse;
    v->ops->nvwrmsnorm = weighted_rms;
    v->ops->nvlinearcombination = linear_combination;
    v->ops->nvscaleaddmulti = scale_add_multi;
  }
};

/// From sixteen states on the general operations are as fast.
constexpr sunindextype small_size = 16;

/// Puts them into a vector; its clones inherit them.
inline void use_small_operations(N_Vector v) {
  switch (const sunindextype n = Small<0>::size(v); n) {
    case 1:
      return Small<1>::put_into(v);
    case 2:
      return Small<2>::put_into(v);
    case 3:
      return Small<3>::put_into(v);
    case 4:
      return Small<4>::put_into(v);
    default:
      if (n <= small_size) Small<0>::put_into(v);
  }
}

}  // namespace saltus::sun
