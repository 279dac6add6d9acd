// IslandProgress: how far the islands have come, while they run.
#pragma once

#include <mutex>

#include "saltus/simulation/detail/island_merger.hpp"

namespace saltus {

/// Counts the islands that have run, on all threads, and the island of the calling thread, so that
/// the progress of the run shows them. Only the calling thread reads it.
class IslandProgress {
 public:
  /// A piece of the run begins.
  void begin() { finished_ = {}, finished_time_ = 0.0; }
  /// The calling thread runs this island.
  void start(const Run& run) { running_ = &run; }
  void stop() { running_ = nullptr; }
  /// An island has run, since this time [s]. Any thread calls it.
  void add(const Run& run, double since) {
    const std::lock_guard lock(mutex_);
    add_counts(finished_, run.results().statistics);
    finished_time_ += run.time() - since;
  }
  /// The piece is over.
  void end() { finished_time_ = 0.0; }

  Statistics counts() const {
    const std::lock_guard lock(mutex_);
    Statistics sum = finished_;
    if (running_ != nullptr) add_counts(sum, running_->results().statistics);
    return sum;
  }
  /// [s] The sum of the times that the islands have run, since this time.
  double time(double since) const noexcept {
    const std::lock_guard lock(mutex_);
    return finished_time_ + (running_ != nullptr ? running_->time() - since : 0.0);
  }

 private:
  mutable std::mutex mutex_;
  const Run* running_ = nullptr;
  Statistics finished_;
  double finished_time_ = 0.0;  // [s]
};

}  // namespace saltus
