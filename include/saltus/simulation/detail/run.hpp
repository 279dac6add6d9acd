// Run: the loop from instant to instant. It implements Simulator.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/detail/endings.hpp"
#include "saltus/simulation/detail/histories.hpp"
#include "saltus/simulation/detail/instant.hpp"
#include "saltus/simulation/detail/integration.hpp"
#include "saltus/simulation/detail/major_steps.hpp"
#include "saltus/simulation/detail/rows.hpp"
#include "saltus/simulation/detail/tangents.hpp"
#include "saltus/simulation/detail/turn.hpp"

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
  /// See Simulator::functions_replaced.
  void functions_replaced();
  double time() const noexcept { return time_; }
  Context context() const;
  const Results& results() const noexcept { return results_; }
  Results take_results();
  const Plan& plan() const noexcept { return machine_.plan(); }
  const SimulatorOptions& options() const noexcept { return options_; }
  std::string describe() const;

  // --- Step by step, for an island that gets events of others: see run_by_steps.cpp. The run takes
  // a step, which counts only once it is known what arrives in it.

  /// Begins to run to t_end [s]: the instant at the start, and the first step.
  void begin_piece(double t_end);
  /// [s] The time at which the step that was taken ends, or is cut by what arrives; infinite if
  /// there is none: the end is reached, or the run is over.
  double next() const noexcept;
  /// Runs while `next` is before `safe` [s], and not after `latest` [s]. All that arrives before
  /// `safe` is known.
  void run_window(double safe, double latest);
  /// Ends the piece at t [s], before its end, by the dense output of the step that was taken.
  void cut_at(double t);
  /// Completes the results.
  void end_piece() { finish(); }
  /// What event wires bring from other islands, and take to them.
  OutsideWires& outside() noexcept { return instant_.outside(); }
  /// Whether the run has ended before the end of the piece.
  bool over() const noexcept { return over_ || results_.status == Status::failed; }

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
  /// A step that was taken and does not count yet.
  struct Taken {
    double to;  ///< [s] its end
    StopReason reason;
    double t_stop;        ///< [s]
    bool failed = false;  ///< nothing was taken: it failed, maybe beyond what arrives
  };
  template <class Act>
  void guarded(const Act& act);
  void commit(double safe);
  Status take_step();
  Status commit_step(double safe);
  StopReason step_again(double& to, double t_stop);
  double next_stop(double t_end);
  void depart(double from);
  std::optional<Status> over_steps(double t_end);
  /// Whether deliveries of other islands are due at t [s].
  bool arrives_by(double t) const { return instant_.next_outside() <= t + Calendar::slack(t); }
  Status arrive(double from, StopReason reason, double t_end, bool arrives);
  Status run_to(double t_end);
  Status begin(double t_end);
  Status step(double t_end);
  void finish_at_event(double from, double t_end);
  void accept(double from);
  Status settle(StopReason reason, double t_end, bool at_start);
  Outcome run_instant(double t_end, bool at_start);
  void log_monitors();
  void keep_step(double from);
  void keep_histories(double from);
  [[noreturn]] void fail_at_pole(double from);
  Status end(Endings::Ending ending);
  void fail(std::string message);
  void finish();
  void count_calls();
  void take_accepted();
  void require_ready(double t_end) const;

  SimulatorOptions options_;
  Machine machine_;
  GuardSet guards_;
  Results results_;
  Instant instant_;
  Calendar calendar_;
  MajorSteps major_;
  Integration integration_;
  Rows rows_;
  Histories histories_;
  Context begin_;
  double time_ = 0.0;
  bool begun_ = false, over_ = false;
  bool behind_event_ = false;  // the solver is a rounding before the present instant
  Accepted accepted_;
  mutable Caller caller_{};
  std::vector<int> due_;
  Endings endings_;
  std::optional<Tangents> tangents_;  // where sensitivities are asked for
  std::optional<Taken> taken_;        // where the run goes step by step
  double t_end_ = 0.0;                // [s] of a piece that goes step by step
};

}  // namespace saltus
