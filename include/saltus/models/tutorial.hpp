// The four scenes of the tutorial "Bouncing Ball" of Collimator, with its tolerances and bounds of
// steps. Times in seconds, heights in metres.
#pragma once

#include <cmath>
#include <vector>

#include "saltus/models/bouncing_ball.hpp"
#include "saltus/models/bouncing_ball_diagram.hpp"

namespace saltus::models {

namespace detail {

inline Scene with_options(std::string name, Scene scene, SimulatorOptions options) {
  options.recorded_signals = scene.options.recorded_signals;
  scene.options = std::move(options);
  scene.name = std::move(name);
  return scene;
}

}  // namespace detail

inline std::vector<Scene> tutorial() {
  const double g = 9.81, y0 = 10.0, t1 = std::sqrt(2.0 * y0 / g);
  const SimulatorOptions leaf{.rtol = 1e-10, .atol = 1e-12, .max_minor_step_size = 1e-3};
  const SimulatorOptions blocks{
      .rtol = 1e-6, .atol = 1e-8, .max_major_step_length = 0.1, .max_minor_step_size = 1e-3};
  using detail::with_options;
  return {with_options("scene 1: a leaf, e = 1",
                       bouncing_ball({.g = g, .e = 1.0, .y0 = y0, .t_end = 6.0 * t1}), leaf),
          with_options("scene 2: a leaf, e = 0.9",
                       bouncing_ball({.g = g, .e = 0.9, .y0 = y0, .t_end = 12.0}), leaf),
          with_options("scene 3: blocks, e = 0.8, the floor drops from under the ball at rest",
                       bouncing_ball_diagram({.g = g,
                                              .e = 0.8,
                                              .y0 = 1e-3,
                                              .floor = 0.0,
                                              .dropped = -1e-3,
                                              .drop_time = 1.0,
                                              .t_end = 1.1}),
                       blocks),
          with_options("scene 4: blocks, e = 0.9, the floor drops in flight",
                       bouncing_ball_diagram({.g = g,
                                              .e = 0.9,
                                              .y0 = y0,
                                              .floor = 5.0,
                                              .dropped = 0.0,
                                              .drop_time = 10.0,
                                              .t_end = 40.0}),
                       blocks)};
}

}  // namespace saltus::models
