// Simulator: a run that can be continued.
#pragma once

#include <memory>
#include <string>

#include "saltus/simulation/options.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

class Run;

/// Advances a context of a system from instant to instant. The system has to outlive it. One
/// simulator serves one thread; it can be initialized again and keeps its memory.
class Simulator {
 public:
  /// Throws ModelError for a system, or an option, that makes no sense.
  explicit Simulator(const System& system, SimulatorOptions options = {});
  /// A run over a plan that others may share, each in a thread of its own; what is recorded is in
  /// the plan already. Throws ModelError if the options record something too.
  explicit Simulator(std::shared_ptr<const Plan> plan, SimulatorOptions options = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// Begins a run at the context's time; one that an earlier run ended with goes on where that one
  /// stopped. Throws ModelError if the context is not one of this system.
  void initialize(const Context& context);

  /// Goes on to t_end [s], or to where the run ends before. In pieces or at once: the same events.
  /// Throws SimulationError with the partial results attached, or what a user's function threw,
  /// unless the option throw_errors is off.
  Status advance_to(double t_end);

  double time() const noexcept;
  /// The values of now.
  Context context() const;
  /// All since initialize(); complete after each advance_to.
  const Results& results() const noexcept;
  /// The same, moved out.
  Results take_results();

  const Plan& plan() const noexcept;
  /// What was kept, folded and dropped, and the method with the reason.
  std::string describe() const;

 private:
  std::unique_ptr<Run> run_;
};

}  // namespace saltus
