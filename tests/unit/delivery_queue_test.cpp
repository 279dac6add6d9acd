// DeliveryQueue: the order of what waits, and the undoing of an instant.
#include "saltus/simulation/detail/delivery_queue.hpp"

#include "support/catch.hpp"
#include "support/run.hpp"

namespace delivery_queue_test {
namespace {

using saltus::DeliveryQueue;

/// The due times [s] and the batches, in the order of the queue.
std::vector<std::pair<double, int>> waiting(const DeliveryQueue& queue) {
  std::vector<std::pair<double, int>> all;
  for (const auto& [key, batch] : queue.waiting()) all.emplace_back(key.first, batch);
  return all;
}

using Waiting = std::vector<std::pair<double, int>>;

}  // namespace

TEST_CASE("deliveries wait by the time they are due, then in the order of the firings",
          "[deliveries]") {
  DeliveryQueue queue;
  CHECK(queue.next() == support::infinite);
  queue.add(2.0, 7), queue.add(1.0, 9), queue.add(3.0, 5), queue.add(1.0, 4);
  CHECK(waiting(queue) == Waiting{{1.0, 9}, {1.0, 4}, {2.0, 7}, {3.0, 5}});
  CHECK(queue.next() == 1.0);
  CHECK(queue.take() == 9);
  CHECK(queue.take() == 4);
  CHECK(queue.next() == 2.0);
  queue.clear();
  CHECK(queue.empty());
}

TEST_CASE("an instant of deliveries is undone: what it added, took, and added and took",
          "[deliveries]") {
  DeliveryQueue queue;
  queue.add(1.0, 1), queue.add(2.0, 2);
  queue.open();
  const Waiting before = waiting(queue);
  queue.take();
  queue.add(0.5, 3), queue.add(1.5, 4);
  queue.take();
  queue.undo();
  CHECK(waiting(queue) == before);
  queue.undo();  // nothing is left to undo
  CHECK(waiting(queue) == before);
}

}  // namespace delivery_queue_test
