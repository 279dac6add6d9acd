// Beam: an elastic beam of length 1, clamped at one end, with a force at the free one: stiff by its
// elasticity and without damping, so that its eigenvalues, up to 6400 j, lie on the imaginary axis.
//   theta'' = C v + D w,  C w = D v + theta'^2
//   v_l = n^4 (theta_{l-1} - 2 theta_l + theta_{l+1}) + n^2 (Fy cos theta_l - Fx sin theta_l)
//   C: 1, 2, ..., 2, 3 on the diagonal, -cos(theta_l - theta_{l-1}) beside it
//   D: -sin(theta_l - theta_{l-1}) below the diagonal, the same with + above it
//   theta_0 = -theta_1, theta_{n+1} = theta_n;  Fy = -Fx = 1.5 sin^2 t until t = pi, then 0
// State: the angles theta of n rods [rad], then their rates, all 0 at t = 0; time in units of the
// beam. N in the block. E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section
// IV.1, (1.10') to (1.20), BEAM; Test Set for IVP Solvers, BEAM.
#pragma once

#include <cmath>
#include <numbers>

#include "saltus/models/beam_reference.hpp"

namespace saltus::models {

class Beam final : public LeafSystem {
 public:
  explicit Beam(Index n = 40) : LeafSystem("beam"), n_(n) {
    if (n < 2) throw ModelError(text("Beam: expected n >= 2 rods, found ", n));
    declare_continuous_state(2 * n, &Beam::ode);
    declare_continuous_state_output("theta");
  }

 private:
  using Column = Eigen::VectorXd;

  void ode(const At& at, VectorRef xdot) const {
    const auto theta = at.x.head(n_), rate = at.x.tail(n_);
    Column cosine(n_), sine(n_);  // of the angle to the rod before
    for (Index l = 1; l < n_; ++l) {
      cosine[l] = std::cos(theta[l] - theta[l - 1]);
      sine[l] = std::sin(theta[l] - theta[l - 1]);
    }
    const Column v = moments(at.time, theta);
    Column w = rate.cwiseAbs2() + turned(sine, v);
    solve(cosine, w);
    xdot.head(n_) = rate;
    xdot.tail(n_) = coupled(cosine, v) + turned(sine, w);
  }
  Column moments(double time, const Eigen::Ref<const Column>& theta) const {
    const double n = static_cast<double>(n_), s = std::sin(time),
                 force = time < std::numbers::pi ? 1.5 * s * s : 0.0;
    Column v(n_);
    for (Index l = 0; l < n_; ++l) {
      const double before = l > 0 ? theta[l - 1] : -theta[0],
                   after = l < n_ - 1 ? theta[l + 1] : theta[l];
      v[l] = n * n * n * n * (before - 2.0 * theta[l] + after) +
             n * n * force * (std::cos(theta[l]) + std::sin(theta[l]));
    }
    return v;
  }
  double diagonal(Index l) const { return l == 0 ? 1.0 : l < n_ - 1 ? 2.0 : 3.0; }
  /// D x.
  Column turned(const Column& sine, const Column& x) const {
    Column out = Column::Zero(n_);
    for (Index l = 1; l < n_; ++l) out[l] -= sine[l] * x[l - 1], out[l - 1] += sine[l] * x[l];
    return out;
  }
  /// C x.
  Column coupled(const Column& cosine, const Column& x) const {
    Column out(n_);
    for (Index l = 0; l < n_; ++l) out[l] = diagonal(l) * x[l];
    for (Index l = 1; l < n_; ++l) out[l] -= cosine[l] * x[l - 1], out[l - 1] -= cosine[l] * x[l];
    return out;
  }
  /// C^-1 x in place, by elimination from the free end.
  void solve(const Column& cosine, Column& x) const {
    Column pivot(n_);
    for (Index l = n_ - 1; l >= 0; --l) {
      const double q = l < n_ - 1 ? cosine[l + 1] / pivot[l + 1] : 0.0;
      pivot[l] = diagonal(l) - (l < n_ - 1 ? q * cosine[l + 1] : 0.0);
      if (l < n_ - 1) x[l] += q * x[l + 1];
    }
    for (Index l = 0; l < n_; ++l) x[l] = (x[l] + (l > 0 ? cosine[l] * x[l - 1] : 0.0)) / pivot[l];
  }

  Index n_;
};

struct BeamParameters {
  Index n = 40;  ///< rods
  double t_end = 5.0;
};

/// Records "theta" at the times of the reference. The growth is the largest row of the propagator
/// of the beam at rest, over times up to 5: nothing is damped, and an error of an angle becomes one
/// of a rate by the frequency of its mode, up to 6400. BDF runs at the edge of its stability, with
/// 5e4 to 1e5 steps, so it does not suit the scene.
inline Scene beam(const BeamParameters& with = {}) {
  const auto beam = std::make_shared<const Beam>(with.n);
  const Exact known =
      with.n == 40 ? detail::beam_reference() : Exact{.provenance = "none: not n = 40"};
  return detail::with_rows_at_samples(
      {.name = "beam",
       .system = beam,
       .context = beam->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"theta", beam->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, known),
       .methods = {Method::radau, Method::automatic},
       .growth = 2.0e4});
}

}  // namespace saltus::models
