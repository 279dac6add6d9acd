// Event log: every event of a run, as data.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/base/view.hpp"

namespace saltus {

enum class EventKind {
  zero_crossing,
  time,
  zeno_enter,
  zeno_release,
  terminal,
  scheduled,  ///< a queued zero crossing triggered
  cancelled,  ///< its guard went back before the execution
  executed    ///< its reset map and its mode were applied
};

inline std::string_view to_string(EventKind kind) {
  constexpr std::string_view names[] = {"zero_crossing", "time",      "zeno_enter", "zeno_release",
                                        "terminal",      "scheduled", "cancelled",  "executed"};
  return nth(names, kind);
}

/// Whether an event of this kind says that a guard or a clock had its effect: it counts as one by
/// its name.
constexpr bool is_firing(EventKind kind) {
  return kind == EventKind::zero_crossing || kind == EventKind::terminal ||
         kind == EventKind::time || kind == EventKind::executed;
}

/// Whether an event of this kind is of a queued zero crossing.
constexpr bool is_of_queue(EventKind kind) { return kind >= EventKind::scheduled; }

/// One event. `before` and `after` are the continuous state of its block at x- and x+.
struct Event {
  double time = 0.0;  ///< [s]
  int jump = 0;       ///< number of passes with a change up to and including this one
  EventKind kind = EventKind::zero_crossing;
  int direction = 0;  ///< +1: its guard was rising, -1: falling, 0: no guard
  std::string_view block;
  std::string_view name;
  /// [s] The predicted accumulation time of a zeno_enter.
  double predicted = std::numeric_limits<double>::quiet_NaN();
  std::span<const double> before, after;
  int entry = 0;  ///< the index of the guard in a vector of guards
  /// The entries of the block's continuous state that rest from a zeno_enter on.
  std::span<const int> rests = {};
  /// [s] The time at which an execution is due, of a queued zero crossing.
  double due = std::numeric_limits<double>::quiet_NaN();
};

/// The name of a declared event. The path of its block has no dot within a name, its own name may
/// have some: "ball" and "y=0.5".
struct EventName {
  std::string block, event;
  std::string full() const { return block + "." + event; }
};

/// Stores events as rows of numbers. It grows by whole rows and keeps its memory from run to run.
class EventLog {
 public:
  std::size_t size() const noexcept { return rows_.size(); }
  bool empty() const noexcept { return rows_.empty(); }

  Event operator[](std::size_t i) const;

  /// The times [s] of the events of one name and kind; empty if it never fired. "ball.bounce" is
  /// that event of that block; a name that is no such path, as "bounce", is that of an event in any
  /// block. Without a kind: when it fired, at a zero crossing, at the end of the run, in time, or when
  /// it was executed.
  /// ModelError for a name that no event of the run has, with the nearest there is.
  std::vector<double> times(std::string_view name, std::optional<EventKind> kind = {}) const;

  /// The name "ball.bounce" of every declared event, fired or not.
  std::vector<std::string> names() const;

  // --- for the engine --------------------------------------------------------------------------
  struct Row {
    double time;
    int jump, direction;
    EventKind kind;
    int source;
    double predicted;  // or due, of a queued zero crossing
    std::size_t states, width;
    int entry = 0;
    std::size_t first_rest = 0, rests = 0;
  };

  void begin(std::vector<EventName> names) { names_ = std::move(names), clear(); }
  void clear() { rows_.clear(), states_.clear(), rests_.clear(); }
  EventLog emptied() const;
  /// Removes all events but the first n.
  void shorten(std::size_t n);
  /// `rests` are the entries of x that rest; the block's begin at `first`.
  void add(Row row, const double* before, const double* after, std::span<const Index> rests = {},
           Index first = 0) {
    row.states = states_.size(), row.first_rest = rests_.size(), row.rests = rests.size();
    for (const Index i : rests) rests_.push_back(static_cast<int>(i - first));
    states_.insert(states_.end(), before, before + row.width);
    states_.insert(states_.end(), after, after + row.width);
    rows_.push_back(row);
  }
  const Row& row(std::size_t i) const { return rows_[i]; }
  /// Appends event i of another log, under a source and a jump of this one.
  void append(const EventLog& other, std::size_t i, int source, int jump);

 private:
  /// The sources that a name means. ModelError if there is none.
  std::vector<bool> called(std::string_view name) const;

  std::vector<Row> rows_;
  std::vector<double> states_;
  std::vector<int> rests_;
  List<EventName> names_;
};

}  // namespace saltus
