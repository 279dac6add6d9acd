// Run: the loop from instant to instant, behind Simulator.
#pragma once

#include <chrono>
#include <memory>
#include <utility>

#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/detail/instant.hpp"
#include "saltus/solver/detail/choose.hpp"

namespace saltus {

/// What Simulator promises, and its memory.
class Run {
 public:
  Run(const System& system, SimulatorOptions options);
  Run(std::shared_ptr<const Plan> plan, SimulatorOptions options);
  Run(const Run&) = delete;  // its parts know each other
  Run& operator=(const Run&) = delete;

  void initialize(const Context& context);
  Status advance_to(double t_end);
  double time() const noexcept { return time_; }
  Context context() const;
  const Results& results() const noexcept { return results_; }
  Results take_results();
  const Plan& plan() const noexcept { return machine_.plan(); }
  const SimulatorOptions& options() const noexcept { return options_; }
  std::string describe() const;

 private:
  void start_recorder();
  Status run_to(double t_end);
  Status step(double t_end);
  void move_to(double t_stop, StopReason& reason);
  Status settle(StopReason reason, double t_end, bool at_start);
  void record_step(double from);
  void record(double t, const double* x);
  void keep_step(double from);
  bool steps_recorded() const { return options_.save_steps.value_or(options_.save_at.empty()); }
  bool interrupted();
  /// Events in a row, since a time.
  struct Series {
    std::int64_t count = 0;
    double since = 0.0;
    /// Counts one more that follows at t; forgets them where none does.
    void next(bool follows, double t) {
      *this = follows ? Series{count + 1, count == 0 ? t : since} : Series{};
    }
    /// Counts one more; true when that makes `size`, and then begins anew at t unless it is kept.
    bool full(std::int64_t size, double t) {
      if (count >= size) *this = {0, t};
      return ++count >= size;
    }
  };
  bool chatters(double t_end, bool idle);
  bool chatters_as(const Series& series) {
    told_ = series;
    return true;
  }
  bool moved() const;
  Status chattering();
  static SimulatorOptions checked(SimulatorOptions options);
  SolverOptions solver_options() const;
  Status end(Status status, std::string message = {});
  void fail(std::string message);
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
  std::int64_t ticks_ = 0;
  Series stuck_, fluttering_, recent_, idle_;  // see chatters
  Series told_;                                // what the message says
  Eigen::VectorXd at_root_;                    // x at the last root
  std::chrono::steady_clock::time_point asked_{};
};

}  // namespace saltus
