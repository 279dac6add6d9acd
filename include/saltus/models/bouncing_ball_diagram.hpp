// The bouncing ball from blocks, over a floor that drops: two Integrators in a row, which are reset
// when y falls below the floor.
//   gravity -> integrator_v -> integrator_y        dv/dt = -g, dy/dt = v
//   y < floor  ->  v := -e v, y := floor           Comparator, Gain "reset_v", Step "floor"
// Heights in m, velocities in m/s. The ball comes to rest on the floor, at the Zeno point of its
// bounces, and falls again when the floor drops from under it; a drop in flight only makes the
// flight longer. Both motions are known exactly. The scene is the last one of the tutorial
// "Bouncing Ball" of Collimator.
#pragma once

#include "saltus/library/library.hpp"
#include "saltus/model/diagram_builder.hpp"
#include "saltus/models/ballistic.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct BouncingBallDiagramParameters {
  double g = 9.81;         ///< [m/s^2]
  double e = 0.8;          ///< coefficient of restitution
  double y0 = 1e-3;        ///< [m]
  double floor = 0.0;      ///< [m] before the drop
  double dropped = -1e-3;  ///< [m] after it
  double drop_time = 1.0;  ///< [s]
  double t_end = 1.1;      ///< [s]
};

inline Diagram make_bouncing_ball_diagram(const BouncingBallDiagramParameters& with = {}) {
  DiagramBuilder builder;
  auto& v = builder.add<Integrator>(
      "integrator_v", Integrator::Options{.enable_reset = true, .enable_external_reset = true});
  auto& y = builder.add<Integrator>(
      "integrator_y", Integrator::Options{.enable_reset = true, .enable_external_reset = true});
  auto& gravity = builder.add<Constant>("constant", -with.g);
  auto& below = builder.add<Comparator>("comparator", "<");
  auto& rebound = builder.add<Gain>("reset_v", -with.e);
  auto& floor = builder.add<Step>("floor", Step::Options{.start_value = with.floor,
                                                         .end_value = with.dropped,
                                                         .step_time = with.drop_time});

  builder.connect(gravity.output(), v.input());
  builder.connect(v.output(), y.input());
  builder.connect(y.output(), below.input(0));
  builder.connect(floor.output(), below.input(1));
  builder.connect(below.output(), v.input("reset_trigger"));
  builder.connect(below.output(), y.input("reset_trigger"));
  builder.connect(floor.output(), y.input("reset_value"));
  builder.connect(v.output(), rebound.input());
  builder.connect(rebound.output(), v.input("reset_value"));
  return builder.build("bouncing_ball");
}

/// With the defaults the ball rests from 0.1285 s until the floor drops at 1 s, and bounces seven
/// times more. Records "y" and "v".
///
/// Growth: an error dy of the height becomes an error of the speed of g / v dy = 70 dy at the first
/// impact. It makes all later flights 2 dv / g (1 + e + ...) longer, and the error of the speed at
/// a given time is 2 / (1 - e) = 10 times as large, with the defaults. One-step methods make no
/// such error; multistep methods make it in the shortest flights.
inline Scene bouncing_ball_diagram(const BouncingBallDiagramParameters& with = {}) {
  Exact exact = ballistic_answer({.g = with.g,
                                  .e = with.e,
                                  .y0 = with.y0,
                                  .floor = with.floor,
                                  .dropped = with.dropped,
                                  .drop_time = with.drop_time},
                                 with.t_end, "integrator_y.reset");
  const auto diagram = std::make_shared<const Diagram>(make_bouncing_ball_diagram(with));
  const System& y = (*diagram)["integrator_y"];
  const Context start = diagram->create_context();
  const Context start_y =
      start[y.system_id()].with_continuous_state(Eigen::VectorXd::Constant(1, with.y0));
  return {.name = "bouncing ball from blocks",
          .system = diagram,
          .context = start.with_subcontext(y.system_id(), start_y),
          .span = {0.0, with.t_end},
          .options = {.recorded_signals = {{"y", y.output()},
                                           {"v", (*diagram)["integrator_v"].output()}}},
          .exact = std::move(exact),
          .gap =
              [with](double t, const Eigen::VectorXd& row) {
                return row[0] - (t <= with.drop_time ? with.floor : with.dropped);
              },
          .methods = {Method::dopri5, Method::dop853, Method::automatic},
          .growth = 700.0};
}

}  // namespace saltus::models
