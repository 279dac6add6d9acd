// Run: the loop from instant to instant, behind Simulator.
#pragma once

#include <chrono>
#include <memory>
#include <utility>

#include "saltus/simulation/calendar.hpp"
#include "saltus/simulation/instant.hpp"
#include "saltus/solver/choose.hpp"

namespace saltus {

/// What Simulator promises, and its memory.
class Run {
 public:
  Run(const System& system, SimulatorOptions options);
  Run(const Run&) = delete;  // its parts know each other
  Run& operator=(const Run&) = delete;

  void initialize(const Context& context);
  Status advance_to(double t_end);
  double time() const noexcept { return time_; }
  Context context() const;
  const Results& results() const noexcept { return results_; }
  Results take_results();
  const Plan& plan() const noexcept { return machine_.plan(); }
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
  bool chatters(double t_end);
  Status chattering();
  SimulatorOptions checked(SimulatorOptions options) const;
  SolverOptions solver_options() const;
  Status end(Status status, std::string message = {});
  void finish();
  /// Puts what rests on a moving surface where that is at t.
  void carry(double t) {
    if (machine_.carrier != nullptr) machine_.carrier->carry(t, machine_.x.data());
  }

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
  std::int64_t recent_events_ = 0, many_events_ = 0, ticks_ = 0;
  double recent_since_ = 0.0, many_since_ = 0.0;
  std::chrono::steady_clock::time_point asked_{};
};

}  // namespace saltus
