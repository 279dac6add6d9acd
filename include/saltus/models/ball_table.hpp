// A ball on a table that moves as A sin(w t), turned round relative to it.
//   dy/dt = v, dv/dt = -g                          while it flies
//   y+ = h, v+ = h' - e (v- - h')                  when y falls to the table, h = A sin(w t)
// State: height y [m], velocity v [m/s]. The flights are parabolas, but the guard is not: the end
// of a flight is the root of a transcendental equation, and the motion of the table enlarges
// errors. With a larger A the scene has the period doublings of J. Guckenheimer, P. Holmes,
// Nonlinear Oscillations, Dynamical Systems, and Bifurcations of Vector Fields, 1983, section 2.4.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct BallTableParameters {
  double g = 10.0;          ///< [m/s^2]
  double e = 0.8;           ///< coefficient of restitution, relative to the table
  double amplitude = 0.05;  ///< [m]
  double w = 10.0;          ///< [rad/s]
  double y0 = 1.0;          ///< [m] above the table
  double v0 = 0.0;          ///< [m/s]
  double t_end = 7.7;       ///< [s]

  template <class Number>
  Number height(Number t) const {
    using std::sin;
    return Number(amplitude) * sin(Number(w) * t);
  }
  template <class Number>
  Number velocity(Number t) const {
    using std::cos;
    return Number(amplitude) * Number(w) * cos(Number(w) * t);
  }
};

class BallTable final : public LeafSystem {
 public:
  explicit BallTable(const BallTableParameters& with) : LeafSystem("ball"), with_(with) {
    declare_continuous_state({.initial = Eigen::Vector2d(with.y0, with.v0),
                              .ode = equations<2>([with](const auto& at, auto& xdot) {
                                xdot[0] = at.x(1), xdot[1] = -with.g;
                              }),
                              .reads = Reads::continuous_state});
    declare_continuous_state_output("state");
    declare_zero_crossing({.name = "bounce",
                           .reset_map = &BallTable::bounce,
                           .direction = Direction::positive_then_non_positive,
                           .formula = Formula([with](const auto& at) {
                                        return at.x(0) - with.height(at.time());
                                      }).called()});
  }

 private:
  void bounce(const At& at, Next& next) const {
    const double table = with_.velocity(at.time);
    next.set_continuous_state({with_.height(at.time), table - with_.e * (at.x[1] - table)});
  }

  BallTableParameters with_;
};

struct Parabola {
  Real g, begin, y, v;

  Real height(Real t) const { return y + (t - begin) * (v - g * (t - begin) / 2); }
  Real velocity(Real t) const { return v - g * (t - begin); }
  Eigen::VectorXd state(Real t) const {
    return Eigen::Vector2d(static_cast<double>(height(t)), static_cast<double>(velocity(t)));
  }
};

/// The search for each landing steps by a hundredth of a radian of the table. Flights shorter than
/// ten such steps are the beginning of a rest on the table, for which no answer is known: the
/// answer ends there.
inline std::optional<ExactPieces<Parabola>> table_flights(const BallTableParameters& with) {
  insist(with.g > 0 && with.w > 0, "ball on a table", "g > 0 and w > 0", std::min(with.g, with.w));
  insist(with.e >= 0 && with.e <= 1, "ball on a table", "0 <= e <= 1", with.e);
  insist(with.y0 > 0, "ball on a table", "y0 above the table", with.y0);
  const Real stride = 0.01L / with.w;
  ExactPieces<Parabola> all{.pieces = {{with.g, 0, with.y0, with.v0}}};
  for (;;) {
    const Parabola flight = all.pieces.back();
    const auto gap = [&](Real t) { return flight.height(t) - with.height(t); };
    const auto landing = first_root(gap, flight.begin, stride, with.t_end);
    if (!landing || *landing > with.t_end) return all;
    if (*landing - flight.begin < 10 * stride) return {};
    const Real table = with.velocity(*landing);
    all.times.push_back(static_cast<double>(*landing));
    all.pieces.push_back({flight.g, *landing, with.height(*landing),
                          table - with.e * (flight.velocity(*landing) - table)});
  }
}

inline Exact table_answer(const BallTableParameters& with) {
  auto flights = table_flights(with);
  if (!flights) return {.provenance = "none: the ball comes to rest on the table"};
  return pieces_answer("parabolas, landings by bisection in extended precision", "ball.bounce",
                       std::move(*flights));
}

/// Twelve bounces with the defaults. Records the state (y, v).
///
/// Growth: a table that moves up or down at a landing turns an error of its time into an error of
/// speed, (1 + e) times its acceleration as large. Carried to the end, an error of the first flight
/// is enlarged 121 times, of the second 55, the third 20; 250 in all (perturbed runs at 1e-13).
inline Scene ball_table(const BallTableParameters& with = {}) {
  const auto ball = std::make_shared<const BallTable>(with);
  return {
      .name = "ball on a sinusoidal table",
      .system = ball,
      .context = ball->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"state", ball->output(0)}}},
      .exact = table_answer(with),
      .gap = [with](double t, const Eigen::VectorXd& row) { return row[0] - with.height(t); },
      .methods = {Method::dopri5, Method::dop853, Method::adams, Method::taylor, Method::automatic},
      .growth = 250.0};
}

}  // namespace saltus::models
