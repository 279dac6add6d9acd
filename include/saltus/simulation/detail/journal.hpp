// Journal: names and counts of all sources of events, the chain of causes, the event log.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/simulation/detail/present.hpp"
#include "saltus/simulation/detail/transition.hpp"
#include "saltus/simulation/options.hpp"
#include "saltus/simulation/results.hpp"
#include "saltus/solver/detail/guard_set.hpp"

namespace saltus {

/// The names of all declared events of a plan, by number of their source; last the names of events
/// that can never fire.
std::vector<EventName> event_names(const Plan& plan);

/// A source of events has a number: guard groups first, then watched edges, then scheduled events.
class Journal {
 public:
  Journal(const Machine& machine, const Transition& transition, const SimulatorOptions& options,
          Results& results);

  /// A run begins: no event has happened yet.
  void begin();
  /// An instant begins: its chain of causes is empty.
  void open(double t);
  /// Forgets the events of this instant.
  void undo();
  /// Events noted from now on belong to the pass that makes the jump count `jump`.
  void at_jump(int jump) noexcept { jump_ = jump; }

  int source_of(Cause cause, int index) const;
  /// "block.event"
  const std::string& name_of(int source) const;
  /// The number of the block that declares it.
  int leaf_of(int source) const;

  struct Entry {
    EventKind kind;
    int source;
    int leaf;
    int direction = 0;
    double predicted = std::numeric_limits<double>::quiet_NaN();
    Index entry = 0;
    std::span<const Index> rests = {};  ///< entries of x that rest from a zeno_enter on
  };
  void note(const Entry& entry);
  /// The state has changed since the last pass, without an event of its own: a block was put at rest on
  /// its surface. It is the state after the events of that pass.
  void renew_after();
  /// The crossing of a monitor, which changes nothing, at the state x.
  void note_monitor(const MonitorHit& hit, const Guard& guard, int jump, const double* x);
  /// A link of the chain of causes.
  void cause(int source);

  /// Whether a firing of a terminal guard ends the run, after `waiting` others that are not logged
  /// yet.
  bool ends_run(int group, std::int64_t waiting = 0) const;
  /// Events noted in this instant.
  int events() const noexcept { return events_; }
  /// The name of the last event; empty before the first one.
  EventName last_event() const;
  /// How often each event happened, by name; events that did not happen are left out.
  std::vector<std::pair<std::string, std::int64_t>> counts() const;
  [[noreturn]] void throw_no_end() const;

  /// Saves how often each guard has fired, which a continued run needs.
  std::vector<std::int64_t> save() const;
  bool fits(const Continuation& from) const { return from.counts.size() == earlier_.size(); }
  void load(const Continuation& from) { earlier_ = from.counts; }

 private:
  EventName event_of(int source) const;
  void add(const Entry& entry, double t, int jump, const double* before, const double* after);

  const Machine* machine_;
  const Plan* plan_;
  const Transition* transition_;
  const SimulatorOptions* options_;
  Results* results_;
  double t_ = 0.0;
  int jump_ = 0, events_ = 0;
  int last_source_ = -1;
  List<std::int64_t> counts_;          // events of each source, in this run
  std::vector<int> counted_;           // the sources of those counted in this instant
  std::size_t logged_ = 0;             // events in the log before this instant
  std::vector<std::int64_t> earlier_;  // firings of each guard before this run
  std::vector<int> chain_;             // sources of the events of this instant
};

}  // namespace saltus
