// The ring modulator as plain functions: 15 states, diodes, two sources. Equations, parameters and
// sources are those of saltus/models/ring_modulator.hpp.
#pragma once

#include <saltus/models/ring_modulator.hpp>

#include "stiff_problem.hpp"

namespace bench {

/// The four diodes: their voltages are signs times y3 to y7 and the carrier.
struct Diodes {
  static constexpr int sign[4][5] = {
      {1, 0, -1, 0, -1}, {0, -1, 0, 1, -1}, {0, 1, 1, 0, 1}, {-1, 0, 0, -1, 1}};
  static constexpr int carrier[4] = {-1, -1, 1, 1};
  double voltage[4];

  Diodes(double t, const double* y) {
    const double in2 = 2.0 * std::sin(2e4 * std::numbers::pi * t);
    for (int i = 0; i < 4; ++i) {
      voltage[i] = carrier[i] * in2;
      for (int k = 0; k < 5; ++k) voltage[i] += sign[i][k] * y[2 + k];
    }
  }
};

inline constexpr saltus::models::RingCircuit ring_parts{};

/// Adds the currents of the diodes, or their derivatives, to the rates of y3 to y7.
inline void conduct(const double* q, double* d) {
  const auto& p = ring_parts;
  d[2] += (-q[0] + q[3]) / p.Cs, d[3] += (q[1] - q[2]) / p.Cs, d[4] += (q[0] - q[2]) / p.Cs;
  d[5] += (-q[1] + q[3]) / p.Cs, d[6] += (q[0] + q[1] - q[2] - q[3]) / p.Cp;
}

/// Adds A y, the part of the circuit without diodes and sources.
inline void linear_part(const double* y, double* d) {
  const auto& p = ring_parts;
  d[0] += (y[7] - 0.5 * y[9] + 0.5 * y[10] + y[13] - y[0] / p.R) / p.C;
  d[1] += (y[8] - 0.5 * y[11] + 0.5 * y[12] + y[14] - y[1] / p.R) / p.C;
  d[2] += y[9] / p.Cs, d[3] -= y[10] / p.Cs, d[4] += y[11] / p.Cs, d[5] -= y[12] / p.Cs;
  d[6] -= y[6] / (p.Rp * p.Cp), d[7] -= y[0] / p.Lh, d[8] -= y[1] / p.Lh;
  d[9] += (0.5 * y[0] - y[2] - p.Rg2 * y[9]) / p.Ls2;
  d[10] += (-0.5 * y[0] + y[3] - p.Rg3 * y[10]) / p.Ls3;
  d[11] += (0.5 * y[1] - y[4] - p.Rg2 * y[11]) / p.Ls2;
  d[12] += (-0.5 * y[1] + y[5] - p.Rg3 * y[12]) / p.Ls3;
  d[13] += (-y[0] - (p.Ri + p.Rg1) * y[13]) / p.Ls1;
  d[14] += (-y[1] - (p.Rc + p.Rg1) * y[14]) / p.Ls1;
}

inline void ring_rates(double t, const double* y, double* d, long n) {
  const Diodes diodes(t, y);
  double q[4];
  for (int i = 0; i < 4; ++i)
    q[i] = ring_parts.gamma * std::expm1(ring_parts.delta * diodes.voltage[i]);
  std::fill_n(d, n, 0.0);
  linear_part(y, d);
  conduct(q, d);
  d[13] += 0.5 * std::sin(2e3 * std::numbers::pi * t) / ring_parts.Ls1;
}

inline void ring_jacobian(double t, const double* y, double* out) {
  std::fill_n(out, 225, 0.0);
  for (int k = 0; k < 15; ++k) {
    double unit[15] = {};
    unit[k] = 1.0;
    linear_part(unit, out + 15 * k);
  }
  const Diodes diodes(t, y);
  const double slope = ring_parts.gamma * ring_parts.delta;
  for (int k = 0; k < 5; ++k) {
    double q[4];
    for (int i = 0; i < 4; ++i)
      q[i] = slope * std::exp(ring_parts.delta * diodes.voltage[i]) * Diodes::sign[i][k];
    conduct(q, out + 15 * (2 + k));
  }
}

inline StiffProblem ring_modulator() {
  return {.name = "ring",
          .start = Eigen::VectorXd::Zero(15),
          .t_end = 1e-3,
          .f = ring_rates,
          .jacobian = ring_jacobian};
}

}  // namespace bench
