// Stiff problems as plain functions, both for a hand-written loop and for a leaf.
#pragma once

#include <cmath>

#include "stiff_problem.hpp"

namespace bench {

/// Van der Pol, mu = 1000, over two thirds of a period and a jump.
inline StiffProblem van_der_pol() {
  return {.name = "vdpol_1e3",
          .start = Eigen::Vector2d(2.0, 0.0),
          .t_end = 2000.0,
          .f =
              [](double, const double* x, double* xdot, long) {
                xdot[0] = x[1];
                xdot[1] = 1000.0 * (1.0 - x[0] * x[0]) * x[1] - x[0];
              },
          .jacobian =
              [](double, const double* x, double* j) {
                j[0] = 0.0, j[1] = -2000.0 * x[0] * x[1] - 1.0;
                j[2] = 1.0, j[3] = 1000.0 * (1.0 - x[0] * x[0]);
              }};
}

/// Robertson's reaction to 4e10 s.
inline StiffProblem robertson() {
  return {.name = "robertson",
          .start = Eigen::Vector3d(1.0, 0.0, 0.0),
          .t_end = 4e10,
          .f =
              [](double, const double* x, double* xdot, long) {
                const double decay = 0.04 * x[0], back = 1e4 * x[1] * x[2], on = 3e7 * x[1] * x[1];
                xdot[0] = back - decay, xdot[1] = decay - back - on, xdot[2] = on;
              },
          .jacobian =
              [](double, const double* x, double* j) {
                const double by2 = 1e4 * x[2], by3 = 1e4 * x[1], on = 6e7 * x[1];
                j[0] = -0.04, j[1] = 0.04, j[2] = 0.0;
                j[3] = by2, j[4] = -by2 - on, j[5] = on;
                j[6] = by3, j[7] = -by3, j[8] = 0.0;
              }};
}

/// HIRES, eight reactants (Test Set for IVP Solvers; E. Hairer, G. Wanner, Solving Ordinary
/// Differential Equations II, p. 144), by differences.
inline StiffProblem hires() {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(8);
  start[0] = 1.0, start[7] = 0.0057;
  return {.name = "hires",
          .start = start,
          .t_end = 321.8122,
          .f = [](double, const double* y, double* d, long) {
            d[0] = -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007;
            d[1] = 1.71 * y[0] - 8.75 * y[1];
            d[2] = -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4];
            d[3] = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3];
            d[4] = -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6];
            d[5] = -280.0 * y[5] * y[7] + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6];
            d[6] = 280.0 * y[5] * y[7] - 1.81 * y[6];
            d[7] = -d[6];
          }};
}

/// The Brusselator with diffusion in one dimension, `cells` cells, u and v in turn (E. Hairer,
/// G. Wanner, Solving Ordinary Differential Equations II, p. 148, BRUSS): alpha = 1/50, boundary
/// values u = 1, v = 3, u(x, 0) = 1 + sin(2 pi x), v(x, 0) = 3, to t = 10.
inline StiffProblem brusselator(long cells) {
  Eigen::VectorXd start(2 * cells);
  for (long i = 0; i < cells; ++i) {
    const double x = static_cast<double>(i + 1) / static_cast<double>(cells + 1);
    start[2 * i] = 1.0 + std::sin(2.0 * 3.14159265358979324 * x), start[2 * i + 1] = 3.0;
  }
  return {.name = "brusselator",
          .start = start,
          .t_end = 10.0,
          .f =
              [](double, const double* x, double* xdot, long n) {
                const long last = n - 2;
                const auto width = static_cast<double>(n / 2 + 1);
                const double c = 0.02 * width * width;
                for (long i = 0; i < n; i += 2) {
                  const double u = x[i], v = x[i + 1], uuv = u * u * v;
                  const double lu = i > 0 ? x[i - 2] : 1.0, lv = i > 0 ? x[i - 1] : 3.0;
                  const double ru = i < last ? x[i + 2] : 1.0, rv = i < last ? x[i + 3] : 3.0;
                  xdot[i] = 1.0 + uuv - 4.0 * u + c * (lu - 2.0 * u + ru);
                  xdot[i + 1] = 3.0 * u - uuv + c * (lv - 2.0 * v + rv);
                }
              },
          .band = 2};
}

}  // namespace bench
