// IslandRuns: the islands of a system as runs of their own. It implements Simulator.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saltus/plan/islands.hpp"
#include "saltus/simulation/detail/island_contexts.hpp"
#include "saltus/simulation/detail/island_interrupt.hpp"
#include "saltus/simulation/detail/island_merger.hpp"
#include "saltus/simulation/detail/island_progress.hpp"
#include "saltus/simulation/detail/island_schedule.hpp"
#include "saltus/simulation/detail/run_by_steps.hpp"

namespace saltus {

/// One island after the other runs to the common end, or several at once on threads. If an island
/// ends the run earlier, at t*, the islands that are ahead run again, from the start of the run to
/// t*. A run is deterministic: each island has the bits of its part run alone to t*, on any number
/// of threads. Islands between which event wires lead run in windows of time: see IslandSchedule. The
/// logs, rows and counts of all islands are put together when they are asked for.
class IslandRuns {
 public:
  IslandRuns(std::shared_ptr<const Plan> plan, Islands islands, SimulatorOptions options);
  IslandRuns(const IslandRuns&) = delete;  // its runs refer to it
  IslandRuns& operator=(const IslandRuns&) = delete;

  void initialize(const Context& context);
  Status advance_to(double t_end);
  void functions_replaced();
  /// [s] The time that all islands have reached; during a run the mean of their times.
  double time() const noexcept;
  Context context() const;
  const Results& results() const noexcept;
  Results take_results();
  const Plan& plan() const noexcept { return *plan_; }
  std::string describe() const;
  Turn claim(std::string_view what) const { return Turn(caller_, time_, what); }

 private:
  struct Island {
    std::unique_ptr<RunBySteps> run;
    Context begin = {};
    bool terminal = false;  ///< it has a guard that ends the run
  };

  SimulatorOptions options_for(std::size_t k, const SimulatorOptions& options);
  void add_island(std::size_t k, const SimulatorOptions& options,
                  const std::vector<std::pair<std::string, int>>& sources);
  void require_ready(double t_end) const;
  void run_all(double t_end);
  double run_in_turn(double t_end);
  double run_side_by_side(double t_end);
  void run_ties_again(double t_end, double end);
  void end_piece(double t_end);
  double run_wired(double t_end);
  void begin_again();
  Statistics counts() const;
  Status run_one(std::size_t k, double t_end);
  void take_end(std::size_t k, Status status, double& t_end);
  void run_again(std::size_t k, double t_end);
  std::size_t threads() const;
  void end_with(std::size_t k);
  Status leave();

  std::shared_ptr<const Plan> plan_;
  Islands islands_;
  SimulatorOptions options_;
  std::vector<std::size_t> order_;  ///< islands that can end the run come first
  std::vector<Island> all_;
  IslandContexts contexts_;
  std::optional<IslandSchedule> schedule_;  ///< if event wires lead from island to island
  mutable Results results_;
  mutable IslandMerger merger_;  ///< writes the columns of results_ where they are asked for
  Context begin_;
  std::vector<double> ends_;  ///< [s] of the pieces of the run
  double time_ = 0.0;         ///< [s]
  bool over_ = false, under_way_ = false, stopped_ = false;
  std::optional<std::size_t> ender_;  ///< the island that ended the run
  IslandInterrupt interrupt_;
  IslandProgress progress_;
  mutable Caller caller_{};
};

}  // namespace saltus
