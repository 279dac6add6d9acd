// Event log: every event of a run, as data.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/plan/plan.hpp"

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

  Event operator[](std::size_t i) const {
    const Row& row = rows_[i];
    const auto [block, name] = split(names_[static_cast<std::size_t>(row.source)]);
    return {row.time,
            row.jump,
            row.kind,
            row.direction,
            block,
            name,
            row.predicted,
            std::span(states_).subspan(row.states, row.width),
            std::span(states_).subspan(row.states + row.width, row.width),
            row.entry};
  }

  /// The times [s] of the events with one name ("bounce" or "ball.bounce") and kind; empty if the
  /// event never fired. ModelError, with the nearest name, for a name that no event of the run has.
  std::vector<double> times(std::string_view name,
                            EventKind kind = EventKind::zero_crossing) const {
    require(name);
    std::vector<double> found;
    for (const Row& row : rows_) {
      if (row.kind == kind && is_called(names_[static_cast<std::size_t>(row.source)], name))
        found.push_back(row.time);
    }
    return found;
  }

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
  EventLog emptied() const {
    EventLog log;
    log.names_ = names_;
    return log;
  }
  void add(Row row, const double* before, const double* after) {
    row.states = states_.size();
    states_.insert(states_.end(), before, before + row.width);
    states_.insert(states_.end(), after, after + row.width);
    rows_.push_back(row);
  }

 private:
  static bool is_called(std::string_view full, std::string_view name) {
    return full == name || split(full).second == name;
  }
  void require(std::string_view name) const {
    const auto has_name = [&](const std::string& full) { return is_called(full, name); };
    if (std::ranges::any_of(names_, has_name)) return;
    std::vector<std::string> known;  // as short or as long as the requested name
    for (const std::string& full : names_) {
      const bool whole = name.find('.') != std::string_view::npos;
      std::string one(whole ? full : split(full).second);
      if (std::ranges::find(known, one) == known.end()) known.push_back(std::move(one));
    }
    throw ModelError(text("no event is called '", name, "'", known_names(name, known)));
  }
  static std::pair<std::string_view, std::string_view> split(std::string_view full) {
    const auto dot = full.rfind('.');
    return dot == std::string_view::npos ? std::pair{full, std::string_view()}
                                         : std::pair{full.substr(0, dot), full.substr(dot + 1)};
  }

  std::vector<Row> rows_;
  std::vector<double> states_;
  std::vector<std::string> names_;
};

}  // namespace saltus
