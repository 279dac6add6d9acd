// The Brusselator on a square, by the method of lines, periodic, with a source that is turned on at
// t = 1.1: stiff by diffusion, and a Jacobian that is sparse but not a band.
//   du/dt = 1 + u^2 v - 4.4 u + alpha N^2 (sum of the four neighbours - 4 u) + f
//   dv/dt = 3.4 u - u^2 v     + alpha N^2 (the same of v)
//   f = 5 where (x - 0.3)^2 + (y - 0.6)^2 <= 0.1^2 and t >= 1.1, else 0;  x_i = i / N, y_j = j / N
//   u(0) = 22 y (1 - y)^1.5, v(0) = 27 x (1 - x)^1.5
// State: u, v of each node in turn, x first. Without units. Parameter alpha = 0.1; N in the block.
// The source is a time event ("source") that changes the mode. E. Hairer, G. Wanner, Solving
// Ordinary Differential Equations II, section IV.10, BRUSS-2D, there with N = 128.
#pragma once

#include <cmath>

#include "saltus/models/brusselator_2d_reference.hpp"

namespace saltus::models {

class Brusselator2d final : public LeafSystem {
 public:
  enum Mode { without_source, with_source };

  explicit Brusselator2d(Index n = 32, double alpha = 0.1) : LeafSystem("square"), n_(n) {
    if (n < 3) throw ModelError(text("Brusselator2d: expected N >= 3 nodes a side, found ", n));
    declare_continuous_state({.initial = start(n), .ode = &Brusselator2d::ode});
    declare_jacobian_sparsity(entries(n));
    declare_continuous_state_output("y");
    // The row of nodes nearest to the middle of the source, u and v in turn.
    declare_output_port(
        {.name = "row",
         .calc = [n](const At& at,
                     VectorRef out) { out = at.x.segment(2 * n * (measured_row(n) - 1), 2 * n); },
         .shape = Shape::of(2 * n),
         .reads = Reads::continuous_state});
    alpha_ = declare_dynamic_parameter("alpha", alpha);
    declare_one_shot(1.1, [](const At&, Next& next) { next.set_mode(with_source); }, "source");
  }

  /// The j with y_j nearest to 0.6.
  static Index measured_row(Index n) { return (6 * n + 5) / 10; }

 private:
  static Eigen::VectorXd start(Index n) {
    Eigen::VectorXd w(2 * n * n);
    for (Index k = 0; k < n * n; ++k) {
      const double x = static_cast<double>(k % n + 1) / static_cast<double>(n),
                   y = static_cast<double>(k / n + 1) / static_cast<double>(n);
      w[2 * k] = 22.0 * y * std::pow(1.0 - y, 1.5);
      w[2 * k + 1] = 27.0 * x * std::pow(1.0 - x, 1.5);
    }
    return w;
  }
  struct Neighbours {
    Index left, right, below, above;
  };
  static Neighbours around(Index k, Index n) {
    const Index i = k % n, j = k / n;
    return {(i + n - 1) % n + n * j, (i + 1) % n + n * j, i + n * ((j + n - 1) % n),
            i + n * ((j + 1) % n)};
  }
  static std::vector<MatrixEntry> entries(Index n) {
    std::vector<MatrixEntry> all;
    for (Index k = 0; k < n * n; ++k) {
      const auto [left, right, below, above] = around(k, n);
      for (Index part = 0; part < 2; ++part) {
        all.push_back({2 * k + part, 2 * k});
        all.push_back({2 * k + part, 2 * k + 1});
        for (const Index other : {left, right, below, above})
          all.push_back({2 * k + part, 2 * other + part});
      }
    }
    return all;
  }
  /// In integers, so that no rounding decides.
  bool in_disc(Index k) const {
    const Index dx = 10 * (k % n_ + 1) - 3 * n_, dy = 10 * (k / n_ + 1) - 6 * n_;
    return dx * dx + dy * dy <= n_ * n_;
  }
  void ode(const At& at, VectorRef xdot) const {
    const VectorView& y = at.x;
    const double size = static_cast<double>(n_), d = at.p[alpha_] * size * size;
    for (Index k = 0; k < n_ * n_; ++k) {
      const auto [left, right, below, above] = around(k, n_);
      const auto spread = [&, l = left, r = right, b = below, a = above](Index part) {
        return d * (y[2 * l + part] + y[2 * r + part] + y[2 * b + part] + y[2 * a + part] -
                    4.0 * y[2 * k + part]);
      };
      const double u = y[2 * k], on = u * u * y[2 * k + 1],
                   source = at.mode == with_source && in_disc(k) ? 5.0 : 0.0;
      xdot[2 * k] = 1.0 + on - 4.4 * u + spread(0) + source;
      xdot[2 * k + 1] = 3.4 * u - on + spread(1);
    }
  }

  Index n_;
  ParameterIndex alpha_;
};

struct Brusselator2dParameters {
  Index n = 32;  ///< nodes a side
  double alpha = 0.1;
  double t_end = 11.5;
};

/// Records the row of nodes through the middle of the source at the times of the reference. The
/// growth is measured: a change of 1e-4 (1 + y) in every entry, of one sign or of several, at nine
/// times, makes errors in the end up to 2.9 times as large. Up to
/// N = 64 the matrices are factorised, which `radau` needs, although the factors fill up.
inline Scene brusselator_2d(const Brusselator2dParameters& with = {}) {
  const auto square = std::make_shared<const Brusselator2d>(with.n, with.alpha);
  Exact known = with.n == 32 && with.alpha == 0.1
                    ? detail::brusselator_2d_reference()
                    : Exact{.provenance = "none: not N = 32 and alpha = 0.1"};
  if (with.t_end >= 1.1) known.events = {detail::firings("square.source", {1.1})};
  return detail::with_rows_at_samples(
      {.name = "Brusselator on a square",
       .system = square,
       .context = square->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6,
                   .atol = 1e-6,
                   .linear_solver = with.n <= 64 ? LinearSolver::sparse : LinearSolver::automatic,
                   .recorded_signals = {{"row", square->output(1)}}},
       .exact = detail::until(with.t_end, with.t_end, std::move(known)),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 3.0});
}

}  // namespace saltus::models
