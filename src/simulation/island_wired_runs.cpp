// IslandRuns: islands between which event wires lead.
#include <limits>

#include "saltus/simulation/detail/island_runs.hpp"

namespace saltus {

/// Runs all islands in windows of time to t_end, or to the earliest end that one of them has. If
/// some are beyond that already, the islands run again to it: what one gets, others have sent. A run
/// is deterministic, so it is the same run. Returns the end.
double IslandRuns::run_wired(double t_end) {
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  const auto asks = [this] { return interrupt_.asks_between(); };
  IslandSchedule::End end = schedule_->run(t_end, no_limit, threads(), asks);
  stopped_ = end.stopped;
  while (end.passed) {
    begin_again();
    end = schedule_->run(t_end, end.time, threads(), [] { return false; });
  }
  ender_ = end.island;
  if (stopped_ && !ender_) ender_ = 0;
  if (end.island && !interrupt_.raised()) stopped_ = false;  // it ended the run at that very time
  return end.time;
}

/// The islands run again through the earlier pieces of the run.
void IslandRuns::begin_again() {
  for (Island& island : all_) island.run->initialize(island.begin);
  schedule_->begin(begin_);
  for (const double piece : ends_) schedule_->run(piece, piece, threads(), [] { return false; });
}

/// The counts of all islands while they run.
Statistics IslandRuns::counts() const {
  if (!schedule_) return progress_.counts();
  Statistics sum;
  for (const Island& island : all_) add_counts(sum, island.run->results().statistics);
  return sum;
}

}  // namespace saltus
