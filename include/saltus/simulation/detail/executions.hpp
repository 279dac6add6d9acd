// Executions: triggers of queued zero crossings, and the executions that follow them.
#pragma once

#include <vector>

#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/detail/execution_queue.hpp"
#include "saltus/simulation/detail/journal.hpp"
#include "saltus/simulation/detail/queue_decisions.hpp"
#include "saltus/simulation/detail/tangent_waits.hpp"

namespace saltus {

/// Schedules, cancels and carries out executions. A trigger is an action of the pass in which its
/// guard fired: its delay, and its values if they are those of the trigger time, are computed from
/// what a reset map sees there. An execution is a pass of its own, after all else that happens at
/// that time. A scene without queued zero crossings asks `any` and `beside`, and nothing else.
class Executions {
 public:
  Executions(Machine& machine, const SimulatorOptions& options, Transition& transition,
             Journal& journal, Present& present);

  /// Whether the scene has queued zero crossings.
  bool any() const noexcept { return any_; }
  /// Throws ModelError for pending executions of zero crossings that the scene does not have.
  void require_fits(const Context& context) const;
  /// A run begins with the executions that wait in a context.
  void begin(const Context& from);
  /// What waits, for a context.
  PendingExecutions save() const;
  void open();
  void undo() { queue_.undo(); }

  /// [s] The time at which the next execution is due; infinite if none waits.
  double next() const noexcept { return queue_.next(); }
  /// Adds those that are due now.
  void add_due(std::vector<DueNow>& all);
  /// Takes the first of the executions that are due, and adds it to the actions of the pass. False
  /// if none is due, or if the pass cancels some of them.
  bool collect();
  /// Schedules or cancels, by the guard that fired.
  void trigger(const Action& action);
  /// Carries out the execution that `collect` found; the guard whose execution it is.
  Index execute(const Action& action);
  /// Whether an execution was carried out in this instant.
  bool executed() const noexcept { return chain_.executions > 0; }
  /// Whether one was carried out that an execution had set off, in this instant or before.
  bool set_off() const noexcept { return set_off_; }
  /// See ExecutionChain.
  int beside() const noexcept { return chain_.beside(); }

 private:
  using Key = ExecutionQueue::Key;
  struct Due {
    std::vector<Key> keys = {};
    std::vector<double> priorities = {};
  };

  const Plan& plan() const { return machine_->plan(); }
  const ZeroCrossing& crossing_of(int group) const {
    return plan().crossing_of(plan().guard(group));
  }
  const std::string& path_of(int group) const { return plan().leaf(plan().guard(group).leaf).path; }
  int group_of(const PendingExecution& one) const;
  std::vector<WaitingExecution> found_in(const PendingExecutions& pending) const;
  void find_due();
  bool cancel_returned();
  bool may_have_gone_back(const WaitingExecution& one) const;
  double priority_of(const WaitingExecution& one) const;
  double draw();
  double delay_of(int group, Index entry) const;
  void schedule(int group, Index entry, int from);
  void cancel(int group, Index entry, int from);
  void look_at_ties(double priority);
  void note(EventKind kind, const WaitingExecution& one, int direction);

  Machine* machine_;
  const SimulatorOptions* options_;
  Transition* transition_;
  Journal* journal_;
  Present* present_;
  bool any_;
  ExecutionQueue queue_;
  ExecutionChain chain_;
  bool set_off_ = false;
  WaitingExecution taken_;  // the execution of this pass
  Due due_;
  std::vector<double> g_;  // the guards before executions
};

}  // namespace saltus
