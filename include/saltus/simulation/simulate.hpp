// simulate: the function that most users call.
#pragma once

#include <utility>

#include "saltus/simulation/simulator.hpp"

namespace saltus {

/// The beginning and the end of a run [s].
struct TimeSpan {
  double begin = 0.0;
  double end = 0.0;
};

/// Runs `system` from the values of `context` over `span`. It returns the recorded rows, the event
/// log, the final context, the status and the statistics. Throws ModelError before the run for bad
/// input, and SimulationError during it with the partial results attached. An exception of a
/// function of the model is rethrown unchanged.
inline Results simulate(const System& system, const Context& context, TimeSpan span,
                        const SimulatorOptions& options = {}) {
  if (!(span.end >= span.begin)) {
    throw ModelError(text("simulate: expected a span with begin <= end, found ", span.begin,
                          " s to ", span.end, " s"));
  }
  Simulator simulator(system, options);
  simulator.initialize(context.time() == span.begin ? context : context.with_time(span.begin));
  simulator.advance_to(span.end);
  return simulator.take_results();
}

}  // namespace saltus
