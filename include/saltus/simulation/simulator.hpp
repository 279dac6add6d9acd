// Simulator: a run that can be continued.
#pragma once

#include <chrono>
#include <memory>
#include <utility>

#include "saltus/simulation/calendar.hpp"
#include "saltus/simulation/instant.hpp"
#include "saltus/solver/choose.hpp"

namespace saltus {

/// Advances a context of a system from instant to instant. The system has to outlive it. One
/// simulator serves one thread; it can be initialized again and keeps its memory.
class Simulator {
 public:
  explicit Simulator(const System& system, SimulatorOptions options = {});

  /// Begins a run at the context's time. Throws ModelError if the context is not one of this
  /// system.
  void initialize(const Context& context);

  /// Goes on to t_end [s], or to where the run ends before. In pieces or at once: the same events.
  /// Throws SimulationError with the partial results attached, or what a user's function threw,
  /// unless the option throw_errors is off.
  Status advance_to(double t_end);

  double time() const noexcept { return time_; }
  /// The values of now.
  Context context() const { return machine_.save(begin_, time_); }
  /// All since initialize(); complete after each advance_to.
  const Results& results() const noexcept { return results_; }
  Results take_results() {
    EventLog next = results_.events.emptied();
    Results taken = std::move(results_);
    results_.events = std::move(next);
    return taken;
  }

  const Plan& plan() const noexcept { return machine_.plan(); }
  /// What was kept, folded and dropped, and the method with the reason.
  std::string describe() const;

 private:
  Status run_to(double t_end);
  Status step(double t_end);
  void move_to(double t_stop, StopReason& reason);
  Status settle(StopReason reason, double t_end, bool at_start);
  void record_step(double from);
  void record(double t, const double* x);
  bool steps_recorded() const { return options_.save_steps.value_or(options_.save_at.empty()); }
  bool interrupted();
  bool chatters();
  SimulatorOptions checked(SimulatorOptions options) const;
  SolverOptions solver_options() const;
  Status end(Status status, std::string message = {});
  void finish();

  SimulatorOptions options_;
  Machine machine_;
  Watch watch_;
  Results results_;
  Instant instant_;
  Calendar calendar_;
  std::optional<Recorder> recorder_;
  std::unique_ptr<Solver> solver_;
  Method method_;
  Context begin_;
  double time_ = 0.0, last_instant_ = 0.0;
  bool begun_ = false, solver_started_ = false, over_ = false;
  std::vector<int> due_;
  std::size_t next_save_ = 0;
  std::int64_t recent_events_ = 0, ticks_ = 0;
  double recent_since_ = 0.0;
  std::chrono::steady_clock::time_point asked_{};
};

}  // namespace saltus
