// IslandProgress: how far the islands have come, while one of them runs after the other.
#pragma once

#include "saltus/simulation/detail/island_merger.hpp"

namespace saltus {

/// Counts the islands that have run and the island under way, so that the progress of the run shows
/// both.
class IslandProgress {
 public:
  /// A piece of the run begins.
  void begin() { finished_ = {}, finished_time_ = 0.0; }
  void start(const Run& run) { running_ = &run; }
  /// The island under way has run, since this time [s].
  void finish(double since) {
    finished_ = counts(), finished_time_ = time(since);
    running_ = nullptr;
  }
  /// The piece is over.
  void end() { finished_time_ = 0.0; }

  Statistics counts() const {
    Statistics sum = finished_;
    if (running_ != nullptr) add_counts(sum, running_->results().statistics);
    return sum;
  }
  /// [s] The sum of the times that the islands have run, since this time.
  double time(double since) const noexcept {
    return finished_time_ + (running_ != nullptr ? running_->time() - since : 0.0);
  }

 private:
  const Run* running_ = nullptr;
  Statistics finished_;
  double finished_time_ = 0.0;  // [s]
};

}  // namespace saltus
