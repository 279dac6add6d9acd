// StopCrossings: the guards that fire at a stop of the solver, where it located no root.
#pragma once

#include "saltus/simulation/detail/monitor_log.hpp"

namespace saltus {

/// Whether a guard crosses at a stop or a rounding later is decided by the flow, not by the rounding of the
/// method.
class StopCrossings {
 public:
  StopCrossings(InstantParts& parts, MonitorLog& monitors) : parts_(&parts), monitors_(&monitors) {}

  /// Time events are due at the stop at t [s], or the run ends there. The guards that fired at the root are
  /// known; this adds the guards that cross at t but for rounding. Returns whether guards fire. `longest` [s] is the time to the
  /// end of the run.
  bool meets(double t, double longest);
  /// Whether the guards that fired at a root, which was located at `root` [s], are at zero at t too, within
  /// their uncertainty. The machine has the state at the root, and the flow leads to t: the step of a
  /// multistep method ends at the root that it located.
  bool roots_are_at(double t, double root, double longest);
  /// After a continuation was loaded: the guards that fire at once, as after an instant that was undone, are
  /// among the guards that fired at the root. False if there are none.
  bool finds_roots();

 private:
  bool crosses(std::size_t k);
  void fire(std::size_t k);

  InstantParts* parts_;
  MonitorLog* monitors_;
};

}  // namespace saltus
