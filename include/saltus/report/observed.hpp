// Observed: the events of a guard in a run's log, in the terms of a known answer.
#pragma once

#include <string_view>
#include <vector>

#include "saltus/report/exact.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

/// Whether an event belongs to the guard "bounce", or "ball.bounce"; "ball.*" means any event of
/// the block, including its time events.
inline bool is_of(const Event& event, std::string_view guard) {
  if (event.name == guard) return true;
  if (guard.ends_with(".*")) return event.block == guard.substr(0, guard.size() - 2);
  return guard.size() == event.block.size() + 1 + event.name.size() &&
         guard.starts_with(event.block) && guard[event.block.size()] == '.' &&
         guard.ends_with(event.name);
}

/// The events of a guard as they happened; accumulation times as predicted at the entry of a hold.
inline std::vector<EventSeries> observed_series(const EventLog& log, std::string_view guard) {
  std::vector<EventSeries> series(1);
  for (std::size_t i = 0; i < log.size(); ++i) {
    const Event event = log[i];
    if (!is_of(event, guard)) continue;
    if (event.kind == EventKind::zeno_enter) {
      series.back().accumulation = event.predicted;
    } else if (event.kind == EventKind::zeno_release) {
      series.back().release = event.time;
      series.emplace_back();
    } else {
      series.back().times.push_back(event.time);
    }
  }
  return series;
}

/// Follows a log row by row and gives the branch of the trajectory.
class BranchWalk {
 public:
  BranchWalk(const EventLog& log, std::string_view guard) : log_(&log), guard_(guard) {}

  /// The branch of the row (t, j). Rows must be asked for in their order.
  const Branch& at(double t, int jump) {
    for (; next_ < log_->size(); ++next_) {
      const Event event = (*log_)[next_];
      if (event.time > t || (event.time == t && event.jump > jump)) break;
      if (is_of(event, guard_)) pass(event.kind);
    }
    return branch_;
  }

 private:
  void pass(EventKind kind) {
    if (kind == EventKind::zeno_enter)
      branch_.rest = true;
    else if (kind == EventKind::zeno_release)
      branch_ = {branch_.series + 1, 0, false};
    else if (!branch_.rest)
      ++branch_.events;
  }

  const EventLog* log_;
  std::string_view guard_;
  std::size_t next_ = 0;
  Branch branch_;
};

}  // namespace saltus
