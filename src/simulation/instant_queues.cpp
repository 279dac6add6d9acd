// What an instant leaves for later: executions of queued zero crossings, deliveries of event wires.
#include <algorithm>

#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

void Instant::require_fits(const Context& context) const {
  executions_.require_fits(context);
  deliveries_.require_fits(context);
}

void Instant::begin_queues(const Context& from) {
  executions_.begin(from);
  deliveries_.begin(from);
  find_next_due();
}

std::shared_ptr<const PendingExecutions> Instant::pending() const {
  if (!may_wait()) return {};
  PendingExecutions saved = executions_.save();
  saved.deliveries = deliveries_.save();
  if (saved.scheduled == 0 && saved.deliveries.empty()) return {};
  return std::make_shared<const PendingExecutions>(std::move(saved));
}

void Instant::open_queues() {
  if (executions_.any()) executions_.open();
  if (deliveries_.any()) deliveries_.open();
  due_before_ = next_due_;
}

/// What is due at the begin of this instant, and the event that it follows from.
std::vector<DueNow> Instant::waiting_due() {
  std::vector<DueNow> all;
  if (deliveries_.any()) deliveries_.add_due(all);
  if (executions_.any()) executions_.add_due(all);
  return all;
}

void Instant::find_next_due() {
  if (!may_wait()) return;
  next_due_ = deliveries_.next();
  if (executions_.any()) next_due_ = std::min(next_due_, executions_.next());
}

}  // namespace saltus
