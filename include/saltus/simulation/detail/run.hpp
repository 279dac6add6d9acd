// Run: the loop from instant to instant. It implements Simulator.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/detail/chattering.hpp"
#include "saltus/simulation/detail/crawl.hpp"
#include "saltus/simulation/detail/instant.hpp"
#include "saltus/simulation/detail/major_steps.hpp"
#include "saltus/simulation/detail/turn.hpp"
#include "saltus/solver/detail/choose.hpp"

namespace saltus {

/// The functions of Simulator, and its memory.
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
  /// Claims the run for a call of `what`.
  Turn claim(std::string_view what) const { return Turn(caller_, time_, what); }

 private:
  /// The last accepted state, which a failure leaves.
  struct Accepted {
    enum class Place {
      start,    ///< the context that the run began with
      machine,  ///< the machine
      solver    ///< the solver, since the end of its last step
    };
    Place place = Place::start;
    bool settled = false;     ///< the events at its time have happened
    bool in_instant = false;  ///< an instant is under way
    std::size_t rows = 0;     ///< before the last instant
  };
  using Place = Accepted::Place;
  void start_recorder();
  Status run_to(double t_end);
  Status begin(double t_end);
  Status step(double t_end);
  void move_to(double t_stop, StopReason& reason);
  Status settle(StopReason reason, double t_end, bool at_start);
  Status after(const Outcome& outcome, const Chattering::Seen& seen, bool idle);
  void record_step(double from);
  void record(double t, const double* x);
  void keep_step(double from);
  bool interrupted();
  Status end_chattering();
  Status end_crawl();
  Status end(Status status, std::string message = {});
  void fail(std::string message);
  void finish();
  void take_accepted();
  void require_ready(double t_end) const;
  /// The solver's state, or the machine's while no solver is at work.
  const Eigen::VectorXd& present_state() const {
    return solver_started_ ? solver_->state() : machine_.x;
  }
  /// Copies the solver's state into the machine, and moves carried blocks onto their surfaces.
  void take_state() {
    machine_.x = solver_->state();
    machine_.put_carried(time_, machine_.x.data());
  }

  SimulatorOptions options_;
  Machine machine_;
  GuardSet guards_;
  Results results_;
  Instant instant_;
  Calendar calendar_;
  MajorSteps major_;
  std::optional<Recorder> recorder_;
  std::unique_ptr<Solver> solver_;
  Context begin_;
  double time_ = 0.0;
  bool begun_ = false, solver_started_ = false, over_ = false;
  Accepted accepted_;
  mutable Caller caller_{};
  std::vector<int> due_;
  std::size_t next_save_ = 0;
  Chattering chattering_;
  Crawl crawl_;
  Eigen::VectorXd row_;  // a state inside the last step
  struct {
    std::int64_t ticks = 0;  // minor steps
    std::chrono::steady_clock::time_point asked{};
  } interrupt_;
};

}  // namespace saltus
