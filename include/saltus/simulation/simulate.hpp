// simulate: the one function most people call.
#pragma once

#include "saltus/simulation/simulator.hpp"

namespace saltus {

/// From when to when, [s].
struct TimeSpan {
  double begin = 0.0;
  double end = 0.0;
};

/// Runs `system` from the values of `context` over `span` and returns what was recorded, the event
/// log, the final context, the status and the statistics. Throws ModelError before the run for bad
/// input, SimulationError during it with the partial results attached, and whatever a function of
/// the model threw, as it was thrown.
Results simulate(const System& system, const Context& context, TimeSpan span,
                 const SimulatorOptions& options = {});

}  // namespace saltus
