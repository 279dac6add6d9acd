// simulate: one whole run.
#include "saltus/simulation/simulate.hpp"

namespace saltus {

Results simulate(const System& system, const Context& context, TimeSpan span,
                 const SimulatorOptions& options) {
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
