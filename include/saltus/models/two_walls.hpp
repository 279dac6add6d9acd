// A ball between two walls, without gravity.
//   dx/dt = v, dv/dt = 0                 between the walls
//   v+ = -e v-                           when x falls to 0 or rises to L
// State: place x [m], velocity v [m/s]. There is nothing to integrate: a method that chooses its
// own step takes a step of any length, and may cross the distance between the walls several times
// in it. The scene measures only the search for roots.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct TwoWallsParameters {
  double length = 1.0;   ///< [m] between the walls
  double e = 1.0;        ///< coefficient of restitution, 0 < e <= 1
  double x0 = 0.25;      ///< [m] between 0 and length
  double v0 = 1.0;       ///< [m/s], not 0
  double t_end = 100.0;  ///< [s]
};

class TwoWalls final : public LeafSystem {
 public:
  explicit TwoWalls(const TwoWallsParameters& with) : LeafSystem("ball"), with_(with) {
    declare_continuous_state(
        {.initial = Eigen::Vector2d(with.x0, with.v0),
         .ode = equations<2>([](const auto& at, auto& xdot) { xdot[0] = at.x(1), xdot[1] = 0.0; }),
         .reads = Reads::continuous_state});
    declare_continuous_state_output("state");
    declare_zero_crossing({.name = "wall",
                           .reset_map = &TwoWalls::bounce,
                           .direction = Direction::positive_then_non_positive,
                           .size = 2,
                           .formula = Formula([with](const auto& at, Index wall) {
                                        return wall == 0 ? at.x(0) : with.length - at.x(0);
                                      }).called()});
  }

 private:
  void bounce(const At& at, Next& next) const {
    next.set_continuous_state({at.entry == 0 ? 0.0 : with_.length, -with_.e * at.x[1]});
  }

  TwoWallsParameters with_;
};

struct Way {
  Real begin, x, v;

  Eigen::VectorXd state(Real t) const {
    return Eigen::Vector2d(static_cast<double>(x + v * (t - begin)), static_cast<double>(v));
  }
};

inline ExactPieces<Way> ways(const TwoWallsParameters& with) {
  insist(with.length > 0, "two walls", "length > 0", with.length);
  insist(with.e > 0 && with.e <= 1, "two walls", "0 < e <= 1", with.e);
  insist(with.x0 > 0 && with.x0 < with.length, "two walls", "x0 between the walls", with.x0);
  insist(with.v0 != 0, "two walls", "a ball that moves", with.v0);
  ExactPieces<Way> all{.pieces = {{0, with.x0, with.v0}}};
  for (;;) {
    const Way way = all.pieces.back();
    const Real wall = way.v > 0 ? with.length : 0, impact = way.begin + (wall - way.x) / way.v;
    if (impact > with.t_end) return all;
    all.times.push_back(static_cast<double>(impact));
    all.pieces.push_back({impact, wall, -with.e * way.v});
  }
}

/// A hundred impacts with the defaults. Records the state (x, v).
///
/// Growth: an error of the speed at the start becomes an error of the place t_end times as large,
/// in weights of 2 and 1. No method makes this error: dv/dt = 0.
inline Scene two_walls(const TwoWallsParameters& with = {}) {
  const auto ball = std::make_shared<const TwoWalls>(with);
  Scene scene{
      .name = "ball between two walls",
      .system = ball,
      .context = ball->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"state", ball->output(0)}}},
      .exact = pieces_answer("closed form: straight lines", "ball.wall", ways(with)),
      .gap = [with](double,
                    const Eigen::VectorXd& row) { return std::min(row[0], with.length - row[0]); },
      .methods = {Method::dopri5, Method::dop853, Method::adams, Method::bdf, Method::radau,
                  Method::taylor, Method::automatic},
      .growth = 2.0 * with.t_end};
  if (with.e == 1.0)
    scene.invariants = {
        {"speed", [](double, const Eigen::VectorXd& row) { return std::abs(row[1]); }}};
  return scene;
}

}  // namespace saltus::models
