// A ball over a floor at 0 in air that resists with the square of the speed.
//   dy/dt = v, dv/dt = -g - c v |v|      while it flies
//   y+ = 0, v+ = -e v-                   when y falls to 0
// State: height y [m], velocity v [m/s]. The flights are no polynomials, so no method is exact on
// them. The right-hand side has a kink in its second derivative at each apex. The bounces
// accumulate at a known time. Drag after Newton, Principia, book II, section 2.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct BallDragParameters {
  double g = 9.81;      ///< [m/s^2]
  double c = 0.05;      ///< [1/m] drag; the terminal speed sqrt(g / c) is 14 m/s
  double e = 0.8;       ///< coefficient of restitution, 0 < e < 1
  double y0 = 10.0;     ///< [m]
  double v0 = 0.0;      ///< [m/s], above minus the terminal speed
  double t_end = 10.0;  ///< [s]
};

class BallDrag final : public LeafSystem {
 public:
  explicit BallDrag(const BallDragParameters& with) : LeafSystem("ball"), with_(with) {
    declare_continuous_state({.initial = Eigen::Vector2d(with.y0, with.v0),
                              .ode = &BallDrag::ode,
                              .jacobian = &BallDrag::jacobian});
    declare_continuous_state_output("state");
    declare_zero_crossing({.name = "bounce",
                           .guard = [](const At& at) { return at.x[0]; },
                           .reset_map = &BallDrag::bounce,
                           .direction = Direction::positive_then_non_positive});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    xdot << at.x[1], -with_.g - with_.c * at.x[1] * std::abs(at.x[1]);
  }
  void jacobian(const At& at, MatrixRef out) const {
    out << 0.0, 1.0, 0.0, -2.0 * with_.c * std::abs(at.x[1]);
  }
  void bounce(const At& at, Next& next) const {
    next.set_continuous_state({0.0, -with_.e * at.x[1]});
  }

  BallDragParameters with_;
};

/// One flight from (y, v) at `begin`, with w = sqrt(g / c): before the apex v = w tan(g d / w),
/// after it v = -w tanh(g d / w), where d > 0 is the time to or from the apex. Heights follow by
/// integration: w^2/g log cos and log cosh.
struct DragFlight {
  Real g, w, begin, y, v;

  Real rise() const { return (v > 0 ? std::atan(v / w) : std::atanh(v / w)) * w / g; }
  Real apex() const {
    return y +
           (v > 0 ? std::log1p(v * v / (w * w)) : -std::log1p(-v * v / (w * w))) * w * w / (2 * g);
  }
  /// g times the apex over w^2, which decides the speed of impact.
  Real drop() const { return g * apex() / (w * w); }
  Real impact() const {
    return begin + rise() + std::asinh(std::sqrt(std::expm1(2 * drop()))) * w / g;
  }
  Real impact_speed() const { return w * std::sqrt(-std::expm1(-2 * drop())); }

  Eigen::VectorXd state(Real t) const {
    const Real s = g * (t - begin - rise()) / w;
    const Real speed = s < 0 ? -std::tan(s) : -std::tanh(s);
    const Real sine = s < 0 ? std::sin(s) : std::sinh(s);
    const Real fall = s < 0 ? -std::log1p(-sine * sine) : std::log1p(sine * sine);
    return Eigen::Vector2d(static_cast<double>(apex() - fall * w * w / (2 * g)),
                           static_cast<double>(w * speed));
  }
};

/// Flights short against w/g are parabolas: the flights after one of 1e-18 s take 2 v/g / (1 - e)
/// together.
inline ExactPieces<DragFlight> drag_flights(const BallDragParameters& with) {
  insist(with.g > 0 && with.c > 0, "ball with drag", "g > 0 and c > 0", std::min(with.g, with.c));
  insist(with.e > 0 && with.e < 1, "ball with drag", "0 < e < 1", with.e);
  insist(with.y0 > 0, "ball with drag", "y0 above the floor", with.y0);
  const Real g = with.g, e = with.e, w = std::sqrt(g / Real(with.c));
  insist(with.v0 > -w, "ball with drag", "v0 above minus the terminal speed", with.v0);
  ExactPieces<DragFlight> all{.pieces = {{g, w, 0, with.y0, with.v0}},
                              .rest = Eigen::Vector2d::Zero()};
  for (;;) {
    const DragFlight& last = all.pieces.back();
    if (last.y == 0 && 2 * last.v < 1e-18L * g) {
      const Real rest = last.begin + 2 * last.v / (g * (1 - e));
      if (rest <= with.t_end) all.accumulation = static_cast<double>(rest);
      return all;
    }
    const Real impact = last.impact();
    if (impact > with.t_end) return all;
    all.times.push_back(static_cast<double>(impact));
    all.pieces.push_back({g, w, impact, 0, e * last.impact_speed()});
  }
}

/// The ball comes to rest at 8.54 s with the defaults. Records the state (y, v).
///
/// Growth: an error dv of the speed makes all later flights 2 dv / g (1 + e + e^2 ...) longer, and
/// the error of the speed at a given time is g times that: 2 / (1 - e) = 10, or 20 with the weights
/// of speeds of 8 m/s and of speeds near 0. The errors of the flights fall at least like their
/// lengths, and add up to 1 / (1 - e) = 5 times the first error.
inline Scene ball_drag(const BallDragParameters& with = {}) {
  Exact exact = pieces_answer("closed form: tan and tanh, flight by flight, in extended precision",
                              "ball.bounce", drag_flights(with));
  const auto ball = std::make_shared<const BallDrag>(with);
  return {.name = "ball with drag",
          .system = ball,
          .context = ball->create_context(),
          .span = {0.0, with.t_end},
          .options = {.rtol = 1e-6, .atol = 1e-5, .recorded_signals = {{"state", ball->output(0)}}},
          .exact = std::move(exact),
          .gap = [](double, const Eigen::VectorXd& row) { return row[0]; },
          .methods = {Method::dopri5, Method::dop853, Method::automatic},
          .growth = 100.0};
}

}  // namespace saltus::models
