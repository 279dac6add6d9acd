// Event log: every event of a run, as data.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace saltus {

enum class EventKind { zero_crossing, time, zeno_enter, zeno_release, terminal };

inline std::string_view to_string(EventKind kind) {
  constexpr std::string_view names[] = {"zero_crossing", "time", "zeno_enter", "zeno_release",
                                        "terminal"};
  return names[static_cast<std::size_t>(kind)];
}

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
};

/// Stores events as rows of numbers. It grows by whole rows and keeps its memory from run to run.
class EventLog {
 public:
  std::size_t size() const noexcept { return rows_.size(); }
  bool empty() const noexcept { return rows_.empty(); }

  Event operator[](std::size_t i) const;

  /// The times [s] of the events of one name ("bounce" or "ball.bounce") and kind; empty if it
  /// never fired. ModelError for a name that no event of the run has, with the nearest there is.
  std::vector<double> times(std::string_view name, EventKind kind = EventKind::zero_crossing) const;

  /// The name "ball.bounce" of every declared event, fired or not.
  const std::vector<std::string>& names() const noexcept { return names_; }

  // --- for the engine --------------------------------------------------------------------------
  struct Row {
    double time;
    int jump, direction;
    EventKind kind;
    int source;
    double predicted;
    std::size_t states, width;
    int entry = 0;
  };

  void begin(std::vector<std::string> names) { names_ = std::move(names), clear(); }
  void clear() { rows_.clear(), states_.clear(); }
  EventLog emptied() const;
  /// Removes all events but the first n.
  void shorten(std::size_t n);
  void add(Row row, const double* before, const double* after) {
    row.states = states_.size();
    states_.insert(states_.end(), before, before + row.width);
    states_.insert(states_.end(), after, after + row.width);
    rows_.push_back(row);
  }

 private:
  static bool is_called(std::string_view full, std::string_view name);
  void require(std::string_view name) const;
  static std::pair<std::string_view, std::string_view> split(std::string_view full);

  std::vector<Row> rows_;
  std::vector<double> states_;
  std::vector<std::string> names_;
};

}  // namespace saltus
