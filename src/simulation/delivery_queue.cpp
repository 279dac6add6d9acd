// DeliveryQueue: what waits, in order, and the undoing of an instant.
#include "saltus/simulation/detail/delivery_queue.hpp"

namespace saltus {

void DeliveryQueue::clear() {
  waiting_.clear(), changes_.clear();
  added_ = 0;
}

void DeliveryQueue::undo() {
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    if (change->added)
      waiting_.erase(change->key);
    else
      waiting_.emplace(change->key, change->batch);
  }
  changes_.clear();
}

std::int64_t DeliveryQueue::add(double t, int batch) {
  const Key key{t, added_++};
  waiting_.emplace_hint(waiting_.end(), key, batch);
  changes_.push_back({key, batch, true});
  return key.second;
}

int DeliveryQueue::take() {
  const auto first = waiting_.begin();
  const int batch = first->second;
  changes_.push_back({first->first, batch, false});
  waiting_.erase(first);
  return batch;
}

}  // namespace saltus
