// Diagrams of parts that read nothing of each other: each part can be built alone, with the same
// paths.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "saltus/library/library.hpp"
#include "saltus/simulation/simulator.hpp"
#include "support/balls.hpp"
#include "support/cases.hpp"

namespace support {

/// A room whose heater has two modes.
inline std::shared_ptr<Leaf> room(const std::string& name, double heat) {
  return make_leaf(name, [heat](Leaf& l) {
    l.declare_continuous_state({.initial = vec({20.0}), .ode = [heat](const At& at) {
                                  return (at.mode == 1 ? heat : 10.0) - at.x[0];
                                }});
    l.declare_continuous_state_output("temperature");
    l.declare_default_mode(1);
    l.declare_zero_crossing({.name = "cold",
                             .guard = [](const At& at) { return at.x[0] - 19.0; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "warm",
                             .guard = [](const At& at) { return at.x[0] - 21.0; },
                             .start_mode = 1,
                             .end_mode = 0});
  });
}

/// The parts of a scene by number: 0 and 1 are balls, 2 is a room, 3 is a sampled sine that is
/// integrated, from three blocks.
inline constexpr int number_of_parts = 4;

inline saltus::Diagram scene_of(const std::set<int>& parts) {
  using namespace saltus;
  DiagramBuilder builder;
  const auto add = [&](int part, std::string name, const std::shared_ptr<const System>& block) {
    if (!parts.contains(part)) return;
    builder.add(block);
    builder.export_output(block->output(0), std::move(name));
  };
  add(0, "first", std::make_shared<Ball>(BallOptions{.e = 0.8}, "first"));
  add(1, "second", std::make_shared<Ball>(BallOptions{.e = 0.5}, "second"));
  add(2, "room", room("room", 30.0));
  if (parts.contains(3)) {
    auto& sine = builder.add<Sine>("sine");
    auto& hold = builder.add<ZeroOrderHold>("hold", 0.25);
    auto& sum = builder.add<Integrator>("sum");
    builder.connect(sine.output(), hold.input()), builder.connect(hold.output(), sum.input());
    builder.export_output(sum.output(), "sum");
  }
  return builder.build();
}

/// All exported outputs, to be recorded.
inline saltus::RecordedSignals outputs_of(const saltus::Diagram& scene) {
  saltus::RecordedSignals all;
  for (std::size_t i = 0; i < scene.outputs().size(); ++i) {
    const saltus::OutputPort port = scene.output(static_cast<int>(i));
    all.emplace_back(scene.outputs()[i].name, port);
  }
  return all;
}

/// The context of a scene whose balls start at 1 m and 2 m.
inline saltus::Context start_of(const saltus::System& scene, const std::set<int>& parts,
                                double t = 0.0) {
  saltus::Context context = scene.create_context(t);
  Eigen::VectorXd x = context.continuous_state();
  saltus::Index at = 0;
  if (parts.contains(0)) x[at] = 1.0, at += 2;
  if (parts.contains(1)) x[at] = 2.0;
  return context.with_continuous_state(x);
}

}  // namespace support
