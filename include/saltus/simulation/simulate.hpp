// simulate: the function that most users call.
#pragma once

#include "saltus/simulation/simulator.hpp"

namespace saltus {

/// The beginning and the end of a run [s].
struct TimeSpan {
  double begin = 0.0;
  double end = 0.0;
};

/// Runs `system` from the values of `context` over `span`. It returns the recorded rows, the event
/// log, the final context, the status and the statistics. Throws ModelError before the run for bad
/// input, SimulationError during it with the partial results attached, and whatever a function of
/// the model threw, as it was thrown.
Results simulate(const System& system, const Context& context, TimeSpan span,
                 const SimulatorOptions& options = {});

}  // namespace saltus
