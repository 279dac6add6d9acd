// A slender block that rocks on its two lower edges after it was released tilted.
//   d2theta/dt2 = p^2 (theta - alpha)    on its right edge, theta > 0
//   d2theta/dt2 = p^2 (theta + alpha)    on its left edge, theta < 0
//   theta'+ = r theta'-                  when theta comes to 0, and the edge changes
// State: tilt theta [rad], theta' [rad/s]. Between impacts the motion is unstable, at rate p. The
// impacts accumulate, although no reset turns the motion round, and the block comes to rest. G. W.
// Housner, "The behavior of inverted pendulum structures during earthquakes", Bull. Seismol. Soc.
// Am. 53 (1963) 403, equations for slender blocks.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct RockingBlockParameters {
  double p = 2.0;       ///< [1/s] sqrt(3 g / 4 R), R half the diagonal: 1.84 m
  double alpha = 0.2;   ///< [rad] between the diagonal and the upright side
  double r = 0.9;       ///< theta'+ / theta'-, 0 < r < 1; 1 - 3/2 sin^2 alpha = 0.94 if inelastic
  double tilt = 0.15;   ///< [rad] where it is let go, 0 < tilt < alpha
  double t_end = 12.0;  ///< [s]
};

class RockingBlock final : public LeafSystem {
 public:
  enum Edge { left = -1, right = 1 };

  explicit RockingBlock(const RockingBlockParameters& with) : LeafSystem("block") {
    declare_continuous_state({.initial = Eigen::Vector2d(with.tilt, 0.0),
                              .ode = equations<2>([with](const auto& at, auto& xdot) {
                                xdot[0] = at.x(1);
                                xdot[1] = with.p * with.p * (at.x(0) - at.mode() * with.alpha);
                              })});
    declare_continuous_state_output("state");
    declare_default_mode(right);
    for (const Edge edge : {right, left}) {
      declare_zero_crossing(
          {.name = edge == right ? "right_to_left" : "left_to_right",
           .reset_map = [with](const At& at,
                               Next& next) { next.set_continuous_state({0.0, with.r * at.x[1]}); },
           .direction = Direction::positive_then_non_positive,
           .start_mode = edge,
           .end_mode = -edge,
           .formula =
               Formula([sign = double(edge)](const auto& at) { return sign * at.x(0); }).called()});
    }
  }
};

/// theta = edge alpha + a cosh p d + b sinh p d, written without cancellation where theta is small.
struct Rock {
  Real p, alpha, begin, theta, rate, edge;

  Eigen::VectorXd state(Real t) const {
    const Real s = p * (t - begin), half = std::sinh(s / 2), away = theta - edge * alpha;
    return Eigen::Vector2d(
        static_cast<double>(theta + 2 * away * half * half + rate / p * std::sinh(s)),
        static_cast<double>(p * away * std::sinh(s) + rate * std::cosh(s)));
  }
};

/// From 0 with the rate u the block returns after 2/p artanh(u / (p alpha)), with the rate u again;
/// the next swing has the rate r u. Once artanh x = x to rounding, the remaining swings are a
/// geometric series.
inline ExactPieces<Rock> rocks(const RockingBlockParameters& with) {
  insist(with.p > 0, "rocking block", "p > 0", with.p);
  insist(with.r > 0 && with.r < 1, "rocking block", "0 < r < 1", with.r);
  insist(with.tilt > 0 && with.tilt < with.alpha, "rocking block", "0 < tilt < alpha", with.tilt);
  const Real p = with.p, alpha = with.alpha, r = with.r, away = alpha - with.tilt;
  ExactPieces<Rock> all{.pieces = {{p, alpha, 0, with.tilt, 0, 1}},
                        .rest = Eigen::Vector2d::Zero()};
  Real t = std::acosh(alpha / away) / p, edge = 1,
       u = p * std::sqrt((alpha - away) * (alpha + away));
  for (;;) {
    if (t > with.t_end) return all;
    all.times.push_back(static_cast<double>(t));
    edge = -edge, u *= r;
    all.pieces.push_back({p, alpha, t, 0, edge * u, edge});
    const Real lasts = 2 / p * std::atanh(u / (p * alpha));
    if (lasts < 1e-18L) {
      const Real rest = t + lasts / (1 - r);
      if (rest <= with.t_end) all.accumulation = static_cast<double>(rest);
      return all;
    }
    t += lasts;
  }
}

/// The block is at rest from 11.04 s on with the defaults. Records the state (theta, theta').
///
/// Growth: an error of theta' moves the next impact by 2 / (p^2 (alpha - theta)) and all later
/// impacts, together 1 / (1 - r) = 10 times as far. It shows in theta' again by the acceleration
/// p^2 alpha. With the weights of a fast block and a slow one, each of the large swings adds 60 to
/// 150 (perturbed runs at 1e-13). The errors of the swings fall at least like their lengths, and
/// add up to 10 times the first error.
inline Scene rocking_block(const RockingBlockParameters& with = {}) {
  const auto block = std::make_shared<const RockingBlock>(with);
  return {
      .name = "rocking block",
      .system = block,
      .context = block->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-7, .recorded_signals = {{"state", block->output(0)}}},
      .exact = pieces_answer("closed form: cosh and sinh, Housner's times", "block.*", rocks(with)),
      .methods = {Method::dopri5, Method::dop853, Method::taylor, Method::automatic},
      .growth = 1500.0};
}

}  // namespace saltus::models
