// Simulator: a run that can be continued.
#pragma once

#include <memory>
#include <string>

#include "saltus/simulation/options.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

class Run;

/// Advances a context of a system from instant to instant. The system must outlive it. One
/// simulator serves one thread. It can be initialized again and keeps its memory.
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
  /// ModelError if the context does not belong to this system.
  void initialize(const Context& context);

  /// Continues to t_end [s], or to an earlier end of the run. A run in pieces has the same events
  /// as a run at once. Throws SimulationError with the partial results attached, or the exception
  /// of a user's function, unless the option throw_errors is off.
  Status advance_to(double t_end);

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
  std::unique_ptr<Run> run_;
};

}  // namespace saltus
