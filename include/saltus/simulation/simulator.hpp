// Simulator: a run that can be continued.
#pragma once

#include <memory>
#include <string>

#include "saltus/simulation/options.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

class Run;
class IslandRuns;

/// Advances a context of a system from instant to instant. The system must outlive it. It can be
/// initialized again and keeps its memory.
///
/// One caller uses a simulator at a time. While a call is under way, each further call of
/// initialize, advance_to, context, take_results or describe throws Error and changes nothing: a
/// call from a callback of the run, and a call from another thread. time() and results() may be
/// read in the thread of the run only.
class Simulator {
 public:
  /// Throws ModelError for an impossible system or option.
  explicit Simulator(const System& system, SimulatorOptions options = {});
  /// A run over a plan that other simulators may share, each in its own thread. The plan already
  /// contains the signals to record. Throws ModelError if the options record something too.
  explicit Simulator(std::shared_ptr<const Plan> plan, SimulatorOptions options = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// Begins a run at the context's time. A context from the end of a run continues that run. Throws
  /// ModelError, and changes nothing, if the context does not belong to this system or is damaged.
  void initialize(const Context& context);

  /// Continues to t_end [s], or to an earlier end of the run. A run in pieces has the same events
  /// as a run at once. Throws SimulationError with the partial results attached, or the exception
  /// of a user's function, unless the option throw_errors is off. After an error results().context
  /// is the last accepted state, to the bit; initialize with it continues the run from there, and
  /// advance_to without it throws ModelError.
  Status advance_to(double t_end);

  /// Has to be called after a function of a leaf of the plan has changed its formula between two
  /// pieces of a run: series that were made of formulas are made anew. Throws ModelError if the
  /// method of the run does not suit them any more.
  void functions_replaced();

  double time() const noexcept;
  /// The present values.
  Context context() const;
  /// Everything since initialize(); complete after each advance_to.
  const Results& results() const noexcept;
  /// The same results, moved out.
  Results take_results();

  const Plan& plan() const noexcept;
  /// Says what was kept, folded and dropped, and names the method with the reason.
  std::string describe() const;

 private:
  std::unique_ptr<Run> run_;             // one step for all states
  std::unique_ptr<IslandRuns> islands_;  // or islands that step apart
};

}  // namespace saltus
