// A circle, and helpers that read its dense output.
#pragma once

#include "support/cases.hpp"
#include "support/oscillator.hpp"

namespace support {

/// x' = y, y' = -x: the circle (cos t, -sin t).
inline std::shared_ptr<Leaf> circle() {
  return make_leaf("circle", [](Leaf& l) {
    declare_oscillator(l, {1.0, 0.0});
    l.declare_continuous_state_output("x");
    l.declare_output_port({.name = "square", .calc = [](const saltus::At& at) {
                             return at.x[0] * at.x[0] + at.time;
                           }});
  });
}

inline saltus::Results run_circle(saltus::SimulatorOptions options, double end = 10.0) {
  static const auto leaf = circle();
  options.recorded_signals = {{"x", leaf->output(0)}, {"square", leaf->output(1)}};
  return saltus::simulate(*leaf, leaf->create_context(), {0.0, end}, options);
}

/// n evenly spread times, without the ends.
inline std::vector<double> inner_times(double begin, double end, int n) {
  std::vector<double> times;
  for (int i = 0; i < n; ++i) times.push_back(begin + (end - begin) * (i + 0.5) / n);
  return times;
}

}  // namespace support
