// WaitingQueues: what an instant leaves for later, executions of queued zero crossings and deliveries of
// event wires.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "saltus/simulation/detail/deliveries.hpp"
#include "saltus/simulation/detail/executions.hpp"

namespace saltus {

/// Both queues as one: what is due next, and what they add to a pass. A scene that has neither asks
/// `may_wait`, and nothing else.
class WaitingQueues {
 public:
  WaitingQueues(Machine& machine, const SimulatorOptions& options, Transition& transition,
                Journal& journal, Present& present)
      : executions_(machine, options, transition, journal, present),
        deliveries_(machine, transition, present),
        present_(&present) {}

  Executions& executions() noexcept { return executions_; }
  Deliveries& deliveries() noexcept { return deliveries_; }

  /// Whether something may wait: an execution, or a delivery of an event wire.
  bool may_wait() const noexcept { return executions_.any() || deliveries_.any(); }
  /// [s] The time at which the next of these is due; null if nothing may wait.
  const double* next_due() const noexcept { return may_wait() ? &next_due_ : nullptr; }
  /// What event wires bring from other islands, and take to them.
  OutsideWires& outside() noexcept { return deliveries_.outside(); }
  /// [s] The time at which the next of these is due; infinite if none waits.
  double next_outside() const noexcept { return deliveries_.outside().next(); }
  /// Whether something that the last instant has scheduled is due before all that waited: the solver
  /// may have stepped beyond it.
  bool stops_earlier() const noexcept { return may_wait() && next_due_ < due_before_; }
  /// Whether executions, or deliveries, set each other off.
  bool set_off() const noexcept { return executions_.set_off() || deliveries_.set_off(); }

  /// Throws ModelError for a context in which something waits that the scene does not have.
  void require_fits(const Context& context) const;
  /// A run begins with what waits in a context.
  void begin(const Context& from);
  /// What waits, for a context; null if nothing ever waited.
  std::shared_ptr<const PendingExecutions> pending() const;

  void open();
  void undo();
  /// Finds what is due next, at the end of an instant.
  void find_next();
  /// What is due at the begin of this instant, and the event that it follows from.
  std::vector<DueNow> due_now();
  /// Adds the deliveries that are due to the pass to come, and an execution if the pass has nothing else.
  void collect();
  /// Applies the reset maps of the deliveries of this pass.
  void deliver();
  /// Passes of this instant that do not count beside its executions: see ExecutionChain.
  int beside() const noexcept { return executions_.beside(); }
  /// Whether something was executed or delivered in this instant.
  bool acted() const noexcept { return executions_.executed() || deliveries_.delivered(); }

 private:
  Executions executions_;
  Deliveries deliveries_;
  Present* present_;
  double next_due_ = std::numeric_limits<double>::infinity();  // [s]
  double due_before_ = next_due_;                              // before this instant
};

}  // namespace saltus
