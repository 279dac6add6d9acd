// What an instant leaves for later: executions of queued zero crossings, deliveries of event wires.
#include "saltus/simulation/detail/waiting_queues.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

void WaitingQueues::require_fits(const Context& context) const {
  executions_.require_fits(context);
  deliveries_.require_fits(context);
}

void WaitingQueues::begin(const Context& from) {
  executions_.begin(from);
  deliveries_.begin(from);
  find_next();
}

std::shared_ptr<const PendingExecutions> WaitingQueues::pending() const {
  if (!may_wait()) return {};
  PendingExecutions saved = executions_.save();
  saved.deliveries = deliveries_.save();
  if (saved.scheduled == 0 && saved.deliveries.empty()) return {};
  return std::make_shared<const PendingExecutions>(std::move(saved));
}

void WaitingQueues::open() {
  if (executions_.any()) executions_.open();
  if (deliveries_.any()) deliveries_.open();
  due_before_ = next_due_;
}

void WaitingQueues::undo() {
  if (executions_.any()) executions_.undo();
  if (deliveries_.any()) deliveries_.undo();
  find_next();
}

void WaitingQueues::find_next() {
  if (!may_wait()) return;
  next_due_ = deliveries_.next();
  if (executions_.any()) next_due_ = std::min(next_due_, executions_.next());
}

std::vector<DueNow> WaitingQueues::due_now() {
  std::vector<DueNow> all;
  if (deliveries_.any()) deliveries_.add_due(all);
  if (executions_.any()) executions_.add_due(all);
  return all;
}

void WaitingQueues::collect() {
  if (deliveries_.any() && deliveries_.collect()) present_->changes = true;
  if (executions_.any() && !present_->changes && present_->actions.empty())
    present_->changes = executions_.collect();
}

void WaitingQueues::deliver() {
  if (deliveries_.any()) deliveries_.run();
}

}  // namespace saltus
