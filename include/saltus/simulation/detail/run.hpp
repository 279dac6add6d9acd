// Run: a run from its first context to its results. It implements Simulator.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "saltus/simulation/detail/run_loop.hpp"
#include "saltus/simulation/detail/turn.hpp"

namespace saltus {

/// The functions of Simulator, and its memory.
class Run : protected RunLoop {
 public:
  Run(const System& system, SimulatorOptions options);
  Run(std::shared_ptr<const Plan> plan, SimulatorOptions options);

  void initialize(const Context& context);
  Status advance_to(double t_end);
  /// See Simulator::functions_replaced.
  void functions_replaced();
  double time() const noexcept { return time_; }
  Context context() const;
  const Results& results() const noexcept { return results_; }
  Results take_results();
  using RunLoop::plan;
  const SimulatorOptions& options() const noexcept { return options_; }
  std::string describe() const;

  /// Claims the run for a call of `what`.
  Turn claim(std::string_view what) const { return Turn(caller_, time_, what); }

 protected:
  template <class Act>
  void guarded(const Act& act);
  void require_ready(double t_end) const;
  void finish();

 private:
  void fail(std::string message);
  void take_accepted();

  mutable Caller caller_{};
};

}  // namespace saltus
