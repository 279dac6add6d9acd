// ExecutionQueue: what waits, in order, and the undoing of an instant.
#include "saltus/simulation/detail/execution_queue.hpp"

namespace saltus {

namespace {

ExecutionQueue::Key key_of(const WaitingExecution& execution) {
  return {execution.pending.due, execution.pending.number};
}

}  // namespace

void ExecutionQueue::clear() { load({}, 0, 0); }

void ExecutionQueue::load(std::vector<WaitingExecution> all, std::int64_t scheduled,
                          std::int64_t draws) {
  waiting_.clear(), of_guards_.clear(), changes_.clear();
  scheduled_ = scheduled, draws_ = draws;
  for (WaitingExecution& one : all) put(std::move(one));
  update();
  open();
}

PendingExecutions ExecutionQueue::save() const {
  PendingExecutions saved{.scheduled = scheduled_, .draws = draws_};
  for (const auto& [key, execution] : waiting_) saved.all.push_back(execution.pending);
  return saved;
}

void ExecutionQueue::open() {
  changes_.clear();
  before_ = {scheduled_, draws_};
}

void ExecutionQueue::undo() {
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    if (change->added)
      remove(key_of(change->execution));
    else
      put(change->execution);
  }
  scheduled_ = before_.scheduled, draws_ = before_.draws;
  update();
  open();
}

std::int64_t ExecutionQueue::add(WaitingExecution execution) {
  const std::int64_t number = execution.pending.number = scheduled_++;
  changes_.push_back({execution, true});
  put(std::move(execution));
  update();
  return number;
}

WaitingExecution ExecutionQueue::take(Key key) {
  WaitingExecution taken = remove(key);
  changes_.push_back({taken, false});
  update();
  return taken;
}

std::optional<ExecutionQueue::Key> ExecutionQueue::of_guard(int group, int entry) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto first = of_guards_.lower_bound({group, entry, {-infinite, 0}});
  if (first == of_guards_.end() || std::get<0>(*first) != group || std::get<1>(*first) != entry)
    return {};
  return std::get<2>(*first);
}

void ExecutionQueue::put(WaitingExecution execution) {
  const Key key = key_of(execution);
  of_guards_.insert({execution.group, execution.pending.entry, key});
  waiting_.emplace(key, std::move(execution));
}

WaitingExecution ExecutionQueue::remove(Key key) {
  WaitingExecution removed = std::move(waiting_.extract(key).mapped());
  of_guards_.erase({removed.group, removed.pending.entry, key});
  return removed;
}

void ExecutionQueue::update() {
  next_ =
      waiting_.empty() ? std::numeric_limits<double>::infinity() : waiting_.begin()->first.first;
}

}  // namespace saltus
