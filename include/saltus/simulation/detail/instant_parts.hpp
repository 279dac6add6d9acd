// InstantParts: what an instant remembers, part by part.
#pragma once

#include <vector>

#include "saltus/simulation/detail/guard_sides.hpp"
#include "saltus/simulation/detail/waiting_queues.hpp"

namespace saltus {

/// The parts of an instant that have a memory. They begin, open, are undone, saved and loaded together; each
/// does its own share. A part knows only the parts above it:
///
///     Transition, Journal, Flow, Edges    x- to x+, events, f at x+, watched signals
///     Holds                               which states rest
///     ContactGuards                       the guards of blocks at rest
///     Relations, CrossingArming           truths; sides of zero crossings
///     WaitingQueues                       what waits, and which comes first
///     GuardSides                          all guards, from pass to pass
struct InstantParts {
  InstantParts(Machine& of, GuardSet& all, const SimulatorOptions& options, Results& results);
  InstantParts(const InstantParts&) = delete;  // they know each other
  InstantParts& operator=(const InstantParts&) = delete;

  /// Clears monitors, relations and held signals for a run that begins at t [s].
  void begin(double t);
  /// Whether the continuation of an earlier run has the shape of this system.
  bool fits(const Continuation& from) const;
  /// After `begin`: loads the continuation of an earlier run. `longest` [s] is the time to the end of this one.
  void load(double t, const Continuation& from, double longest);
  /// What a continued run needs.
  Continuation save() const;
  /// An instant begins at t [s]: what each part knew of the last one is forgotten, and what `undo` needs is
  /// kept. The guards that fired at the root are the firings of the first pass.
  void open(double t, double longest);
  /// Undoes the instant under way: all is as before it, and the guards that fired will fire again.
  void undo();
  /// The guards that fired at the root of this instant.
  const std::vector<Firing>& roots() const noexcept { return roots_; }

  Machine& machine;
  GuardSet& guards;
  Scope scope;
  Present present;
  Transition transition;
  Journal journal;
  Flow flow;
  Edges edges;
  Holds holds;
  ContactGuards contacts;
  Relations relations;
  CrossingArming crossings;
  WaitingQueues queues;
  GuardSides sides;
  int jump = 0;  ///< the jump count

 private:
  List<Guard> guards_before_;
  std::vector<Firing> roots_;
  int jump_before_ = 0;
};

}  // namespace saltus
