// Newton's cradle: n equal elastic balls that hang next to each other, with a small gap.
//   dx_i/dt = v_i, dv_i/dt = -w^2 (x_i - i d)    small swings about the place where ball i hangs
//   v_i+ = v_{i+1}-, v_{i+1}+ = v_i-             when x_{i+1} - x_i falls to 0
// State: places x [m], without the balls' diameters, velocities v [m/s]. The first ball is
// released, and the last one flies off: n - 1 impacts follow each other within d / v, after swings
// of half a second. With d = 0 rounding decides the number of impacts, because balls rest at the
// same place. E. Mariotte, Traite de la percussion ou choc des corps, 1673.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct NewtonsCradleParameters {
  int balls = 5;           ///< 2 or more
  double gap = 1e-3;       ///< [m] d > 0, between balls that hang still
  double w = 5.0;          ///< [rad/s] sqrt(g / length of the strings)
  double amplitude = 0.1;  ///< [m] the first ball is let go this far out, above n d
  double t_end = 2.0;      ///< [s]
};

class NewtonsCradle final : public LeafSystem {
 public:
  explicit NewtonsCradle(const NewtonsCradleParameters& with)
      : LeafSystem("cradle"), n_(with.balls), w_(with.w), hangs_(n_) {
    for (Index i = 0; i < n_; ++i) hangs_[i] = static_cast<double>(i) * with.gap;
    Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * n_);
    start.head(n_) = hangs_;
    start[0] = -with.amplitude;
    declare_continuous_state(
        {.initial = start, .ode = &NewtonsCradle::ode, .reads = Reads::continuous_state});
    declare_continuous_state_output("state");
    declare_zero_crossing({.name = "impact",
                           .guard = &NewtonsCradle::gaps,
                           .reset_map = &NewtonsCradle::impact,
                           .direction = Direction::positive_then_non_positive,
                           .size = n_ - 1});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    xdot.head(n_) = at.x.tail(n_);
    xdot.tail(n_) = w_ * w_ * (hangs_ - at.x.head(n_));
  }
  void gaps(const At& at, VectorRef out) const {
    out = at.x.segment(1, n_ - 1) - at.x.head(n_ - 1);
  }
  void impact(const At& at, Next& next) const {
    Eigen::VectorXd x = at.x;
    std::swap(x[n_ + at.entry], x[n_ + at.entry + 1]);
    next.set_continuous_state(x);
  }

  Index n_;
  double w_;               // [rad/s]
  Eigen::VectorXd hangs_;  // [m]
};

/// Free swings of all balls, from places x and velocities v at `begin`.
struct Swings {
  Real w, gap, begin;
  std::vector<Real> x, v;

  Real place(std::size_t i, Real t) const {
    const Real hangs = static_cast<Real>(i) * gap, s = w * (t - begin);
    return hangs + (x[i] - hangs) * std::cos(s) + v[i] / w * std::sin(s);
  }
  Real velocity(std::size_t i, Real t) const {
    const Real hangs = static_cast<Real>(i) * gap, s = w * (t - begin);
    return v[i] * std::cos(s) - w * (x[i] - hangs) * std::sin(s);
  }
  Eigen::VectorXd state(Real t) const {
    const auto n = static_cast<Index>(x.size());
    Eigen::VectorXd all(2 * n);
    for (std::size_t i = 0; i < x.size(); ++i) {
      all[static_cast<Index>(i)] = static_cast<double>(place(i, t));
      all[n + static_cast<Index>(i)] = static_cast<double>(velocity(i, t));
    }
    return all;
  }
};

/// Goes from impact to impact, each time to the first impact of all pairs. The search steps by a
/// twentieth of a gap at full speed. A pair that has just met is apart again after one step.
inline ExactPieces<Swings> swings(const NewtonsCradleParameters& with) {
  insist(with.balls >= 2, "Newton's cradle", "2 balls or more", with.balls);
  insist(with.w > 0, "Newton's cradle", "w > 0", with.w);
  insist(with.gap > 0, "Newton's cradle", "a gap > 0", with.gap);
  insist(with.amplitude > with.balls * with.gap, "Newton's cradle", "an amplitude above n gaps",
         with.amplitude);
  const auto n = static_cast<std::size_t>(with.balls);
  const Real stride = with.gap / (20 * Real(with.w) * with.amplitude);
  Swings now{with.w, with.gap, 0, std::vector<Real>(n), std::vector<Real>(n)};
  for (std::size_t i = 0; i < n; ++i) now.x[i] = static_cast<Real>(i) * now.gap;
  now.x[0] = -with.amplitude;
  ExactPieces<Swings> all{.pieces = {now}};
  for (;;) {
    Real first = with.t_end;
    std::size_t pair = n;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const auto apart = [&](Real t) { return now.place(i + 1, t) - now.place(i, t); };
      const auto meet = first_root(apart, now.begin, stride, first);
      if (meet && *meet < first) first = *meet, pair = i;
    }
    if (pair == n) return all;
    Swings next = now;
    next.begin = first;
    for (std::size_t i = 0; i < n; ++i)
      next.x[i] = now.place(i, first), next.v[i] = now.velocity(i, first);
    next.x[pair + 1] = next.x[pair];
    std::swap(next.v[pair], next.v[pair + 1]);
    all.times.push_back(static_cast<double>(first));
    all.pieces.push_back(now = next);
  }
}

/// Three chains of four impacts with the defaults. Records the state: n places, n velocities.
///
/// Growth: a swing does not enlarge an error, but v and x differ by the factor w = 5, and the
/// weights of a ball in motion and a ball at rest by 2. Each of 13 pieces adds 3 to 10, in total 83
/// (perturbed runs at 1e-13).
inline Scene newtons_cradle(const NewtonsCradleParameters& with = {}) {
  const auto cradle = std::make_shared<const NewtonsCradle>(with);
  const Index n = with.balls;
  return {
      .name = "Newton's cradle",
      .system = cradle,
      .context = cradle->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-7, .recorded_signals = {{"state", cradle->output(0)}}},
      .exact = pieces_answer("swings, impacts by bisection in extended precision", "cradle.impact",
                             swings(with)),
      .invariants = {{"energy per mass",
                      [n, with](double, const Eigen::VectorXd& row) {
                        double energy = 0.0;
                        for (Index i = 0; i < n; ++i) {
                          const double stretch =
                              with.w * (row[i] - static_cast<double>(i) * with.gap);
                          energy += 0.5 * (row[n + i] * row[n + i] + stretch * stretch);
                        }
                        return energy;
                      }}},
      .gap =
          [n](double, const Eigen::VectorXd& row) {
            return (row.segment(1, n - 1) - row.head(n - 1)).minCoeff();
          },
      .methods = {Method::dopri5, Method::dop853, Method::adams, Method::automatic},
      .growth = 90.0};
}

}  // namespace saltus::models
