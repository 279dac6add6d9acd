// Instant: all that happens at one time value, in passes, until nothing changes.
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "saltus/simulation/detail/collector.hpp"
#include "saltus/simulation/detail/effects.hpp"
#include "saltus/simulation/detail/instant_rows.hpp"

namespace saltus {

/// Runs passes. In a pass the relations that were crossed flip, and held outputs follow. Reset maps
/// and updates run, all from x-, and are committed together. Then the relations are read again.
/// Zero crossings that the commit moved across zero fire in the next pass. A part knows only the
/// parts above it:
///
///     Transition, Journal, Flow, Edges    x- to x+, events, f at x+, watched signals
///     Holds                               which states rest
///     ContactGuards                       the guards of blocks at rest
///     Relations, CrossingArming           truths; sides of zero crossings
///     Executions                          the queue: what waits, and which comes first
///     Deliveries                          what event wires carry, and what they carry later
///     Collector, Effects                  the actions of a pass; carrying them out
class Instant {
 public:
  Instant(Machine& machine, GuardSet& guards, const SimulatorOptions& options, Results& results);
  Instant(const Instant&) = delete;  // its parts know each other
  Instant& operator=(const Instant&) = delete;
  /// From now on `tangents` differentiates each instant.
  void follow(Tangents* tangents) noexcept { transition_.follow(tangents); }

  /// Clears monitors, relations and held signals for a run that begins at t. Nothing fires yet.
  void begin(double t, Recorder* recorder);
  /// Whether the continuation of an earlier run has the shape of this system.
  bool fits(const Continuation& from) const;
  /// Begins a run as `begin` does, and loads the continuation of an earlier run; `longest` as in
  /// `run`.
  void resume(double t, Recorder* recorder, const Continuation& from, double longest);
  /// The continuation: each part saves the values that a continued run needs.
  Continuation save() const;

  /// Runs the instant at t, with the guards that fired at the root and the time events in `due`.
  /// `longest` [s] is the time to the end of the run.
  Outcome run(double t, const std::vector<int>& due, double longest, bool at_start = false);

  /// At a stop of the solver at t, where time events are due or the run ends: the guards whose crossing is
  /// there but for rounding are among those that fired at the root. True if guards fire.
  bool meets_stop(double t, double longest);
  /// Whether the guards that fired at a root, which was located at `root` [s], are at zero at t too, within
  /// their uncertainty. The machine has the state at the root, and the flow leads to t: the step of a
  /// multistep method ends at the root that it located.
  bool roots_are_at(double t, double root, double longest);

  /// Whether something may wait: an execution, or a delivery of an event wire.
  bool may_wait() const noexcept { return executions_.any() || deliveries_.any(); }
  /// [s] The time at which the next of these is due; null if nothing may wait.
  const double* next_due() const noexcept { return may_wait() ? &next_due_ : nullptr; }
  /// What event wires bring from other islands, and take to them.
  OutsideWires& outside() noexcept { return deliveries_.outside(); }
  /// [s] The time at which the next of these is due; infinite if none waits.
  double next_outside() const noexcept { return deliveries_.outside().next(); }
  /// Throws ModelError for a context in which something waits that the scene does not have.
  void require_fits(const Context& context) const;
  /// A run begins with what waits in a context.
  void begin_queues(const Context& from);
  /// What waits, for a context; null if nothing ever waited.
  std::shared_ptr<const PendingExecutions> pending() const;
  /// Whether something that the last instant has scheduled is due before all that waited: the solver
  /// may have stepped beyond it.
  bool stops_earlier() const noexcept { return may_wait() && next_due_ < due_before_; }
  /// Whether executions, or deliveries, set each other off.
  bool set_off() const noexcept { return executions_.set_off() || deliveries_.set_off(); }

  /// Undoes the instant under way, whose effects failed: guards, holds, signals, events and values
  /// are as before it, and the guards that fired will fire again.
  void undo();
  /// After `resume`: the guards that fire at once, as after an instant that was undone, are among
  /// the guards that fired at the root. False if there are none.
  bool finds_roots();

  /// Whether `run` at t has to log this crossing of a monitor: it jumped at the root there, at which
  /// relations are among the guards that fired, `roots`. So it may come back when they flip.
  bool judges(const MonitorHit& hit, double t, const std::vector<Firing>& roots) const;
  /// Logs the crossing of a monitor, which changes nothing, at the state x.
  void log_monitor(const MonitorHit& hit, const double* x);

  int jump() const noexcept { return jump_; }
  const Contacts& contacts() const noexcept { return contacts_.contacts(); }
  /// f at the end of the last instant, if it is known.
  const Eigen::VectorXd* flow() const noexcept { return flow_.known(); }
  const Journal& journal() const noexcept { return journal_; }

 private:
  /// What an instant changes, before it; values are in the transition.
  struct Before {
    List<Guard> guards = {};
    std::vector<Firing> roots = {};
    int jump = 0;
  };

  void open(double t, const std::vector<int>& due, double longest);
  bool crosses_at_stop(std::size_t k);
  void fire_at_stop(std::size_t k);
  void turn_beside_root();
  bool collect();
  void judge_jumps(bool flipped);
  void log_judged_monitors(bool flipped);
  void run_pass();
  void commit();
  void find_next();
  bool stays_at_root(std::size_t k) const;
  void look_at_crossing(std::size_t k);
  bool left_zero_beside_root(std::size_t k);
  void continue_beside_root(std::size_t k);
  /// Whether nothing is to be decided about a zero crossing: it is on its side, nothing is known of it in
  /// this instant, and no block is at rest. With many guards most are such at each event.
  [[gnu::always_inline]] bool is_untouched(std::size_t k) const {
    return !present_.has_facts(k) && (*guards_)[k].stays(present_.g[k]) && !holds_.any();
  }
  void mark_armed_at(std::size_t k);
  void forget_firing(std::size_t k);
  void arm(bool at_start);
  void select_guards();
  bool follow_controls();
  void look_at_guards();
  void open_queues();
  void find_next_due();
  std::vector<DueNow> waiting_due();

  const Plan& plan() const { return machine_->plan(); }

  Machine* machine_;
  GuardSet* guards_;
  const SimulatorOptions* options_;
  Scope scope_;
  Present present_;
  InstantRows rows_;
  Transition transition_;
  Journal journal_;
  Flow flow_;
  Edges edges_;
  Holds holds_;
  ContactGuards contacts_;
  Relations relations_;
  CrossingArming crossings_;
  Executions executions_;
  Deliveries deliveries_;
  Collector collector_;
  Effects effects_;
  int jump_ = 0;
  Before before_;
  double next_due_ = std::numeric_limits<double>::infinity();  // [s]
  double due_before_ = next_due_;                              // before this instant
};

}  // namespace saltus
