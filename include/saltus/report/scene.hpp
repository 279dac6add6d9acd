// Scene: a system with all that a run of it needs, and what is known about the outcome.
#pragma once

#include <memory>
#include <string>

#include "saltus/report/exact.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

struct Scene {
  std::string name;
  std::shared_ptr<const System> system;
  Context context;
  TimeSpan span;
  SimulatorOptions options = {};  ///< with recorded_signals in the order of Exact::state
  Exact exact = {};
};

/// Runs a scene with its own options.
inline Results simulate(const Scene& scene) {
  return simulate(*scene.system, scene.context, scene.span, scene.options);
}

}  // namespace saltus
