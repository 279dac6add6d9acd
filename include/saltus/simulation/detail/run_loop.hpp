// RunLoop: from instant to instant, and from step to step.
#pragma once

#include <optional>
#include <vector>

#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/detail/endings.hpp"
#include "saltus/simulation/detail/histories.hpp"
#include "saltus/simulation/detail/instant.hpp"
#include "saltus/simulation/detail/integration.hpp"
#include "saltus/simulation/detail/major_steps.hpp"
#include "saltus/simulation/detail/rows.hpp"
#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

/// What a run is made of, and how it gets from the present time to a later one. An exception of the model
/// passes through it: `Run` turns it into a failure.
class RunLoop {
 protected:
  RunLoop(std::shared_ptr<const Plan> plan, SimulatorOptions options);
  RunLoop(const RunLoop&) = delete;  // its parts know each other
  RunLoop& operator=(const RunLoop&) = delete;
  ~RunLoop() = default;

  const Plan& plan() const noexcept { return machine_.plan(); }
  Status run_to(double t_end);
  Status begin(double t_end);
  Status step(double t_end);
  double next_stop(double t_end);
  void depart(double from);
  Status arrive(double from, StopReason reason, double t_end, bool arrives);
  std::optional<Status> over_steps(double t_end);
  /// Whether deliveries of other islands are due at t [s].
  bool arrives_by(double t) const {
    return instant_.queues().next_outside() <= t + Calendar::slack(t);
  }
  Status end(Endings::Ending ending);
  void count_calls();

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
  std::vector<int> due_;
  Endings endings_;
  std::optional<Tangents> tangents_;  // where sensitivities are asked for

 private:
  void finish_at_event(double from, double t_end);
  void accept(double from);
  Status settle(StopReason reason, double t_end, bool at_start);
  bool instant_begins(StopReason& reason, double t_end, bool at_start);
  Outcome run_instant(double t_end, bool at_start);
  void log_monitors();
  void keep_step(double from);
  void keep_histories(double from);
  [[noreturn]] void fail_at_pole(double from);
};

}  // namespace saltus
