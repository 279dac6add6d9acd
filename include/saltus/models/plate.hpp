// Plate: a rectangular plate over which a vehicle drives, its two wheel tracks each with two axles.
// The friction makes it stiff and the elasticity too: real eigenvalues from -1000 to the slow end,
// and pairs of them that oscillate.
//   u_tt + omega u_t + sigma (Laplacian of the Laplacian of u) = f(x, y, t) on 2 by 4/3
//   f = 200 (exp(-5 (t - x - 2)^2) + exp(-5 (t - x - 5)^2)) on the lines y_2 and y_4, else 0
// The plate is simply supported: u and its Laplacian are 0 at the edges. 8 by 5 points inside, a
// distance h = 2/9 apart, the Laplacian by five points. State: u, x first, then du/dt, all 0 at t =
// 0. Without units. Parameters omega = 1000 (friction) and sigma = 100 (stiffness). The problem is
// linear. E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.10, PLATE.
#pragma once

#include <cmath>

#include "saltus/base/list.hpp"
#include "saltus/models/plate_reference.hpp"

namespace saltus::models {

class Plate final : public LeafSystem {
 public:
  static constexpr Index across = 8, along = 5, points = across * along;

  explicit Plate(double omega = 1000.0, double sigma = 100.0) : LeafSystem("plate") {
    declare_continuous_state(2 * points, &Plate::ode);
    declare_jacobian_sparsity(entries());
    declare_continuous_state_output("u");
    omega_ = declare_dynamic_parameter("omega", omega);
    sigma_ = declare_dynamic_parameter("sigma", sigma);
  }

 private:
  static Index number(Index i, Index j) { return i + across * j; }
  static bool inside(Index i, Index j) { return i >= 0 && i < across && j >= 0 && j < along; }
  /// Within two points of each other along a line, or one along a diagonal.
  static std::vector<MatrixEntry> entries() {
    std::vector<MatrixEntry> all;
    for (Index k = 0; k < points; ++k) {
      all.push_back({k, points + k});
      all.push_back({points + k, points + k});
      for (Index di = -2; di <= 2; ++di) {
        for (Index dj = -2; dj <= 2; ++dj) {
          const Index i = k % across + di, j = k / across + dj;
          if (std::abs(di) + std::abs(dj) <= 2 && inside(i, j))
            all.push_back({points + k, number(i, j)});
        }
      }
    }
    return all;
  }
  /// The sum of the neighbours less four times the point; 0 outside.
  template <class Column>
  static double bend(const Column& u, Index i, Index j) {
    const auto at = [&](Index a, Index b) { return inside(a, b) ? u[number(a, b)] : 0.0; };
    return at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1) - 4.0 * at(i, j);
  }
  static double load(double t, Index i, Index j) {
    if (j != 1 && j != 3) return 0.0;
    const double x = static_cast<double>(i + 1) * 2.0 / 9.0, front = t - x - 2.0,
                 rear = t - x - 5.0;
    return 200.0 * (std::exp(-5.0 * front * front) + std::exp(-5.0 * rear * rear));
  }
  void ode(const At& at, VectorRef xdot) const {
    const double h = 2.0 / 9.0, stiffness = at.p[sigma_] / (h * h * h * h);
    std::array<double, points> bent;
    for (Index k = 0; k < points; ++k) nth(bent, k) = bend(at.x, k % across, k / across);
    const Eigen::Map<const Eigen::VectorXd> again(bent.data(), points);
    for (Index k = 0; k < points; ++k) {
      const Index i = k % across, j = k / across;
      xdot[k] = at.x[points + k];
      xdot[points + k] =
          load(at.time, i, j) - at.p[omega_] * at.x[points + k] - stiffness * bend(again, i, j);
    }
  }

  ParameterIndex omega_, sigma_;
};

struct PlateParameters {
  double omega = 1000.0;  ///< friction
  double sigma = 100.0;   ///< stiffness
  double t_end = 7.0;
};

/// Records "u" at the times of the reference; atol = 1e-3 rtol, because u stays below 0.014. The
/// growth: see hires.hpp. It is that of errors which alternate from point to point: they bend the
/// plate sharply and become errors of the speed.
inline Scene plate(const PlateParameters& with = {}) {
  const auto plate = std::make_shared<const Plate>(with.omega, with.sigma);
  const Exact known = with.omega == 1000.0 && with.sigma == 100.0
                          ? detail::plate_reference()
                          : Exact{.provenance = "none: not omega = 1000 and sigma = 100"};
  return detail::with_rows_at_samples(
      {.name = "plate",
       .system = plate,
       .context = plate->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-9, .recorded_signals = {{"u", plate->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, known),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 3260.0});
}

}  // namespace saltus::models
