// CUSP: 32 nerve cells on a ring. Each fires by a threshold (the cusp catastrophe of its fast y)
// and is driven by an oscillator of Van der Pol's kind; diffusion couples the cells.
//   dy_i/dt = -(y_i^3 + a_i y_i + b_i) / epsilon               + D (y_{i-1} - 2 y_i + y_{i+1})
//   da_i/dt = b_i + 0.07 v_i                                   + D (a_{i-1} - 2 a_i + a_{i+1})
//   db_i/dt = (1 - a_i^2) b_i - a_i - 0.4 y_i + 0.035 v_i      + D (b_{i-1} - 2 b_i + b_{i+1})
//   v = u / (u + 0.1), u = (y - 0.7) (y - 1.3);  D = N^2 / 144;  cell 0 is cell N
//   y_i(0) = 0, a_i(0) = -2 cos(2 pi i / N), b_i(0) = 2 sin(2 pi i / N)
// State: y_1, a_1, b_1, y_2, ...: a band with two corners. Without units. Parameter epsilon = 1e-4;
// N in the block. E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.10,
// CUSP.
#pragma once

#include <cmath>
#include <numbers>

#include "saltus/models/cusp_reference.hpp"

namespace saltus::models {

class Cusp final : public LeafSystem {
 public:
  explicit Cusp(Index n = 32, double epsilon = 1e-4) : LeafSystem("nerve"), n_(n) {
    if (n < 3) throw ModelError(text("Cusp: expected N >= 3 cells, found ", n));
    Eigen::VectorXd start(3 * n);
    for (Index i = 0; i < n; ++i) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(i + 1) / static_cast<double>(n);
      start.segment<3>(3 * i) << 0.0, -2.0 * std::cos(angle), 2.0 * std::sin(angle);
    }
    declare_continuous_state({.initial = std::move(start), .ode = &Cusp::ode});
    declare_jacobian_sparsity(entries(n));
    declare_continuous_state_output("y");
    epsilon_ = declare_dynamic_parameter("epsilon", epsilon);
  }

 private:
  /// A cell among its own three, and each of them with its neighbours.
  static std::vector<MatrixEntry> entries(Index n) {
    std::vector<MatrixEntry> all;
    for (Index i = 0; i < n; ++i) {
      for (Index k = 0; k < 3; ++k) {
        for (Index other = 0; other < 3; ++other) all.push_back({3 * i + k, 3 * i + other});
        all.push_back({3 * i + k, 3 * ((i + 1) % n) + k});
        all.push_back({3 * i + k, 3 * ((i + n - 1) % n) + k});
      }
    }
    return all;
  }
  void ode(const At& at, VectorRef xdot) const {
    const double size = static_cast<double>(n_), d = size * size / 144.0;
    for (Index i = 0; i < n_; ++i) {
      const Eigen::Vector3d cell = at.x.segment<3>(3 * i);
      const double y = cell[0], a = cell[1], b = cell[2], u = (y - 0.7) * (y - 1.3),
                   v = u / (u + 0.1);
      xdot.segment<3>(3 * i) << -(y * y * y + a * y + b) / at.p[epsilon_], b + 0.07 * v,
          (1.0 - a * a) * b - a - 0.4 * y + 0.035 * v;
      xdot.segment<3>(3 * i) += d * (at.x.segment<3>(3 * ((i + n_ - 1) % n_)) - 2.0 * cell +
                                     at.x.segment<3>(3 * ((i + 1) % n_)));
    }
  }

  Index n_;
  ParameterIndex epsilon_;
};

struct CuspParameters {
  Index n = 32;  ///< cells
  double epsilon = 1e-4;
  double t_end = 1.1;
};

/// Records "y" at the start and at t = 1.1. The growth: see hires.hpp.
inline Scene cusp(const CuspParameters& with = {}) {
  const auto nerve = std::make_shared<const Cusp>(with.n, with.epsilon);
  const Exact known = with.n == 32 && with.epsilon == 1e-4
                          ? detail::cusp_reference()
                          : Exact{.provenance = "none: not N = 32 and epsilon = 1e-4"};
  return detail::with_rows_at_samples(
      {.name = "CUSP",
       .system = nerve,
       .context = nerve->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"y", nerve->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, known),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 4.6});
}

}  // namespace saltus::models
