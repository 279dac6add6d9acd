// ExecutionQueue: the executions of queued zero crossings that wait, in the order in which they are
// due.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "saltus/model/pending.hpp"

namespace saltus {

/// An execution that waits in a run.
struct WaitingExecution {
  PendingExecution pending = {};
  int group = -1;  ///< its group of guards in the plan
  int chain = 1;   ///< executions of the instant of its trigger that led to it, and itself
};

/// The only writer of the executions that wait. To add, to cancel or to take one of n costs log n.
/// What an instant changed is undone at the same cost, so an instant copies no queue.
class ExecutionQueue {
 public:
  /// By due time [s], then in the order of their triggers.
  using Key = std::pair<double, std::int64_t>;
  using Waiting = std::map<Key, WaitingExecution>;

  /// Nothing waits.
  void clear();
  void load(std::vector<WaitingExecution> all, std::int64_t scheduled, std::int64_t draws);
  PendingExecutions save() const;

  /// An instant begins: `undo` goes back to here.
  void open();
  void undo();

  /// Adds an execution, which gets the next number; the number.
  std::int64_t add(WaitingExecution execution);
  /// Takes an execution out, by its key.
  WaitingExecution take(Key key);
  /// The execution of a guard that waits, if there is one; the earliest of several.
  std::optional<Key> of_guard(int group, int entry) const;
  /// The number of the next random draw.
  std::int64_t draw() { return draws_++; }

  bool empty() const noexcept { return waiting_.empty(); }
  const Waiting& waiting() const noexcept { return waiting_; }
  /// [s] The first time at which one is due; infinite if none waits. Its address does not change.
  const double& next() const noexcept { return next_; }
  /// Whether an execution was scheduled in this instant.
  bool is_new(const PendingExecution& one) const { return one.number >= before_.scheduled; }

 private:
  struct Change {
    WaitingExecution execution;
    bool added;
  };
  struct Counts {
    std::int64_t scheduled = 0, draws = 0;
  };
  void put(WaitingExecution execution);
  WaitingExecution remove(Key key);
  void update();

  Waiting waiting_;
  std::set<std::tuple<int, int, Key>> of_guards_;  // group, entry and key of each
  double next_ = std::numeric_limits<double>::infinity();
  std::int64_t scheduled_ = 0, draws_ = 0;
  Counts before_;
  std::vector<Change> changes_;  // of this instant
};

}  // namespace saltus
