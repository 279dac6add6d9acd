// The collocation polynomial of a step.
#pragma once

#include <array>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/radau/scheme.hpp"

namespace saltus::radau {

/// The values l_1(s), ..., l_S(s) of the Lagrange polynomials of the nodes 0, c_1, ..., c_S, of
/// which the first is left out, at the part s of the step (J.-P. Berrut, L. N. Trefethen,
/// "Barycentric Lagrange interpolation", SIAM Review 46 (2004) 501, (4.2)).
inline std::array<double, most_stages> lagrange(const Scheme& scheme, double s) {
  std::array<double, most_stages> l{};
  if (s == 0.0) return l;
  double sum = scheme.weights[0] / s;
  for (int j = 0; j < scheme.stages; ++j) {
    const auto k = static_cast<std::size_t>(j);
    if (s == scheme.c[j]) {
      l = {};
      l[k] = 1.0;
      return l;
    }
    l[k] = scheme.weights[j + 1] / (s - scheme.c[j]);
    sum += l[k];
  }
  for (double& each : l) each /= sum;
  return l;
}

/// x(t0 + s h) = x0 + sum_j l_j(s) z_j with the stages z_j = x(t0 + c_j h) - x0. The error is
/// h^(S + 1), also if the step itself is better. Column j of z is z_j.
struct StagePolynomial {
  explicit StagePolynomial(Eigen::Index n) : z(n, most_stages) {}

  /// x0 is the state at the begin of the step.
  void read(const double* x0, double s, double* x) const {
    const auto l = lagrange(scheme_of(stages), s);
    const Eigen::Index n = z.rows();
    for (Eigen::Index i = 0; i < n; ++i) {
      double sum = 0.0;
      for (int j = 0; j < stages; ++j) sum += nth(l, j) * z(i, j);
      x[i] = x0[i] + sum;
    }
  }

  /// Writes to `out` the stages of another step, of `to` stages, that begins at the part `from` of
  /// this step and has `ratio` times its length.
  void predict(int to, double from, double ratio, Eigen::MatrixXd& out) const {
    const Scheme here = scheme_of(stages), there = scheme_of(to);
    const auto begin = lagrange(here, from);
    for (int i = 0; i < to; ++i) {
      const auto l = lagrange(here, from + ratio * there.c[i]);
      out.col(i).setZero();
      for (int j = 0; j < stages; ++j) {
        const auto k = static_cast<std::size_t>(j);
        out.col(i) += (l[k] - begin[k]) * z.col(j);
      }
    }
  }

  /// From the begin of the step to its end.
  auto end() const { return z.col(stages - 1); }

  int stages = stage_counts.front();
  Eigen::MatrixXd z;
};

}  // namespace saltus::radau
