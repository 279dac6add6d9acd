// A ball over a floor at 0, as one leaf: the smallest hybrid system with a Zeno point.
//   dy/dt = v, dv/dt = -g        while it flies
//   y+ = |y-|, v+ = -e v-        when y falls to 0
// State: height y [m], velocity v [m/s]. Parameters, in the context: g [m/s^2], e (coefficient of
// restitution). Flights are parabolas. They are known exactly, and so is the Zeno time t1 (1 + e) /
// (1 - e), t1 = sqrt(2 y0 / g). Newton's law of restitution; the scene is the first one of the
// tutorial "Bouncing Ball" of Collimator.
#pragma once

#include <memory>

#include "saltus/models/ballistic.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

class BouncingBall final : public LeafSystem {
 public:
  explicit BouncingBall(double g = 9.81, double e = 1.0) : LeafSystem("ball") {
    g_ = declare_dynamic_parameter("g", g);
    e_ = declare_dynamic_parameter("e", e);
    declare_continuous_state(2, equations<2>([k = g_](const auto& at, auto& xdot) {
                               xdot[0] = at.x(1), xdot[1] = -at.p(k, 0);
                             }));
    declare_continuous_state_output("ball:y");
    declare_jacobian([](const At&, MatrixRef jacobian) { jacobian << 0.0, 1.0, 0.0, 0.0; });
    declare_zero_crossing({.name = "bounce",
                           .reset_map = &BouncingBall::bounce,
                           .direction = Direction::positive_then_non_positive,
                           .formula = Formula([](const auto& at) { return at.x(0); }).called()});
  }

 private:
  void bounce(const At& at, Next& next) const {
    next.set_continuous_state({std::abs(at.x[0]), -at.p[e_] * at.x[1]});
  }

  ParameterIndex g_;  // [m/s^2]
  ParameterIndex e_;  // coefficient of restitution, 0 <= e <= 1
};

struct BouncingBallParameters {
  double g = 9.81;      ///< [m/s^2]
  double e = 0.9;       ///< coefficient of restitution
  double y0 = 10.0;     ///< [m]
  double v0 = 0.0;      ///< [m/s]
  double t_end = 12.0;  ///< [s]
};

/// The ball bounces six times with the defaults; with a longer span it comes to rest at 27.13 s.
/// Records "y", the state (y, v).
///
/// Growth: an error dv of the speed makes the flight 2 dv / g longer, and the heights after it are
/// wrong by v times that: 14 * 2 / 9.81 = 2.9. The tolerance of a speed of 14 m/s is rtol, of a
/// height 0 only atol, a hundredth of that: so the error is 4000 tolerances of the height. Each
/// flight adds 4000 to 8000, all six add 27000 (perturbed runs at 1e-13), with the defaults.
/// One-step methods make no such error.
inline Scene bouncing_ball(const BouncingBallParameters& with = {}) {
  Exact exact = ballistic_answer({.g = with.g, .e = with.e, .y0 = with.y0, .v0 = with.v0},
                                 with.t_end, "ball.bounce");
  const auto ball = std::make_shared<const BouncingBall>(with.g, with.e);
  Scene scene{
      .name = "bouncing ball",
      .system = ball,
      .context = ball->create_context().with_continuous_state(Eigen::Vector2d(with.y0, with.v0)),
      .span = {0.0, with.t_end},
      .options = {.recorded_signals = {{"y", ball->output(0)}}},
      .exact = std::move(exact),
      .gap = [](double, const Eigen::VectorXd& row) { return row[0]; },
      .methods = {Method::dopri5, Method::dop853, Method::adams, Method::taylor, Method::automatic},
      .growth = 2.7e4};
  if (with.e == 1.0)
    scene.invariants = {{"energy per mass", [g = with.g](double, const Eigen::VectorXd& row) {
                           return g * row[0] + 0.5 * row[1] * row[1];
                         }}};
  return scene;
}

}  // namespace saltus::models
