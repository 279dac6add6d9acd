// ExecutionQueue: the order of what waits, what a guard has waiting, and the undoing of an instant.
#include "saltus/simulation/detail/execution_queue.hpp"

#include "support/catch.hpp"
#include "support/run.hpp"

using namespace saltus;

namespace {

WaitingExecution due_at(double due, int group = 0, int entry = 0) {
  return {.pending = {.entry = entry, .due = due}, .group = group};
}

/// The due times and the numbers, in the order of the queue.
std::vector<ExecutionQueue::Key> keys(const ExecutionQueue& queue) {
  std::vector<ExecutionQueue::Key> all;
  for (const auto& [key, execution] : queue.waiting()) all.push_back(key);
  return all;
}

using Keys = std::vector<ExecutionQueue::Key>;

}  // namespace

TEST_CASE("executions wait by the time they are due, then in the order of their triggers",
          "[queue]") {
  ExecutionQueue queue;
  CHECK(queue.next() == support::infinite);
  for (const double due : {2.0, 1.0, 3.0, 1.0}) queue.add(due_at(due));
  CHECK(keys(queue) == Keys{{1.0, 1}, {1.0, 3}, {2.0, 0}, {3.0, 2}});
  CHECK(queue.next() == 1.0);
  queue.take({1.0, 1}), queue.take({1.0, 3});
  CHECK(queue.next() == 2.0);
  queue.take({2.0, 0}), queue.take({3.0, 2});
  CHECK(queue.empty());
  CHECK(queue.next() == support::infinite);
}

TEST_CASE("the execution of a guard is found among those of others", "[queue]") {
  ExecutionQueue queue;
  queue.add(due_at(1.0, 0, 1)), queue.add(due_at(9.0, 1, 0)), queue.add(due_at(5.0, 1, 0));
  queue.add(due_at(2.0, 1, 2));
  CHECK(queue.of_guard(0, 1) == ExecutionQueue::Key{1.0, 0});
  CHECK(queue.of_guard(1, 0) == ExecutionQueue::Key{5.0, 2});  // the earliest
  CHECK(queue.of_guard(1, 2) == ExecutionQueue::Key{2.0, 3});
  CHECK_FALSE(queue.of_guard(0, 0));
  CHECK_FALSE(queue.of_guard(1, 1));
  CHECK_FALSE(queue.of_guard(2, 0));
  queue.take({5.0, 2});
  CHECK(queue.of_guard(1, 0) == ExecutionQueue::Key{9.0, 1});
}

TEST_CASE("an instant is undone: what it added, took, and added and took", "[queue]") {
  ExecutionQueue queue;
  queue.add(due_at(1.0)), queue.add(due_at(2.0));
  queue.open();
  const PendingExecutions before = queue.save();
  queue.take({1.0, 0});
  queue.add(due_at(1.5, 3, 1)), queue.add(due_at(0.5));
  queue.take({0.5, 3});
  queue.draw();
  CHECK(queue.is_new(queue.waiting().at({1.5, 2}).pending));
  CHECK_FALSE(queue.is_new(queue.waiting().at({2.0, 1}).pending));
  queue.undo();
  CHECK(queue.save() == before);
  CHECK(queue.next() == 1.0);
  CHECK_FALSE(queue.of_guard(3, 1));
  CHECK(queue.of_guard(0, 0) == ExecutionQueue::Key{1.0, 0});
  CHECK(queue.draw() == 0);
}

TEST_CASE("what was saved is loaded, with the counts that the next ones need", "[queue]") {
  ExecutionQueue queue, other;
  for (const double due : {4.0, 3.0}) queue.add(due_at(due));
  queue.draw(), queue.draw();
  const PendingExecutions saved = queue.save();
  CHECK((saved.scheduled == 2 && saved.draws == 2 && saved.all.size() == 2));
  std::vector<WaitingExecution> all;
  for (const PendingExecution& one : saved.all) all.push_back({one, 0});
  other.load(all, saved.scheduled, saved.draws);
  CHECK(other.save() == saved);
  other.add(due_at(3.0));
  CHECK(keys(other) == Keys{{3.0, 1}, {3.0, 2}, {4.0, 0}});
  CHECK(other.draw() == 2);
}
