// Instant: all that happens at one time value, in passes, until nothing changes.
#pragma once

#include <vector>

#include "saltus/simulation/detail/collector.hpp"
#include "saltus/simulation/detail/effects.hpp"
#include "saltus/simulation/detail/instant_parts.hpp"
#include "saltus/simulation/detail/instant_rows.hpp"
#include "saltus/simulation/detail/monitor_log.hpp"
#include "saltus/simulation/detail/stop_crossings.hpp"

namespace saltus {

/// Runs passes. In a pass the relations that were crossed flip, and held outputs follow. Reset maps
/// and updates run, all from x-, and are committed together. Then the relations are read again.
/// Zero crossings that the commit moved across zero fire in the next pass. The memory of an instant is
/// InstantParts; Collector finds the actions of a pass, Effects carries them out.
class Instant {
 public:
  Instant(Machine& machine, GuardSet& guards, const SimulatorOptions& options, Results& results);
  Instant(const Instant&) = delete;  // its parts know each other
  Instant& operator=(const Instant&) = delete;
  /// From now on `tangents` differentiates each instant.
  void follow(Tangents* tangents) noexcept { parts_.transition.follow(tangents); }

  /// Begins a run at t. Nothing fires yet.
  void begin(double t, Recorder* recorder) { rows_.begin(recorder), parts_.begin(t); }
  /// Begins a run as `begin` does, and loads the continuation of an earlier run; `longest` as in
  /// `run`.
  void resume(double t, Recorder* recorder, const Continuation& from, double longest) {
    begin(t, recorder), parts_.load(t, from, longest);
  }
  bool fits(const Continuation& from) const { return parts_.fits(from); }
  Continuation save() const { return parts_.save(); }

  /// Runs the instant at t, with the guards that fired at the root and the time events in `due`.
  /// `longest` [s] is the time to the end of the run.
  Outcome run(double t, const std::vector<int>& due, double longest, bool at_start = false);
  /// Undoes the instant under way, whose effects failed: guards, holds, signals, events and values
  /// are as before it, and the guards that fired will fire again.
  void undo() { parts_.undo(); }

  WaitingQueues& queues() noexcept { return parts_.queues; }
  const WaitingQueues& queues() const noexcept { return parts_.queues; }
  StopCrossings& stops() noexcept { return stops_; }
  MonitorLog& monitors() noexcept { return monitors_; }
  int jump() const noexcept { return parts_.jump; }
  const Contacts& contacts() const noexcept { return parts_.contacts.contacts(); }
  /// f at the end of the last instant, if it is known.
  const Eigen::VectorXd* flow() const noexcept { return parts_.flow.known(); }
  const Journal& journal() const noexcept { return parts_.journal; }

 private:
  void open(double t, const std::vector<int>& due, double longest);
  bool is_endless();
  bool collect();
  void judge_jumps(bool flipped);
  void tell_tangents();
  void run_pass();
  void commit();
  const Outcome& close();

  const SimulatorOptions* options_;
  InstantParts parts_;
  InstantRows rows_;
  MonitorLog monitors_;
  StopCrossings stops_;
  Collector collector_;
  Effects effects_;
};

}  // namespace saltus
