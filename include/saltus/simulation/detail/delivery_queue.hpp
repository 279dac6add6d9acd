// DeliveryQueue: the firings that event wires have not delivered yet, in the order in which they are
// due.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace saltus {

/// The only writer of the deliveries that wait. One entry is a firing for all wires of one delay, so
/// it costs log n of the entries that wait, and nothing for each wire. What an instant changed is
/// undone at the same cost.
class DeliveryQueue {
 public:
  /// By due time [s], then in the order of the firings.
  using Key = std::pair<double, std::int64_t>;
  using Waiting = std::map<Key, int>;

  /// Nothing waits.
  void clear();

  /// An instant begins: `undo` goes back to here.
  void open() noexcept { changes_.clear(); }
  void undo();

  /// Adds a delivery of a batch of wires, due at t [s]; its number.
  std::int64_t add(double t, int batch);
  /// Takes the first delivery out; its batch.
  int take();

  bool empty() const noexcept { return waiting_.empty(); }
  const Waiting& waiting() const noexcept { return waiting_; }
  /// [s] The first time at which one is due; infinite if none waits.
  double next() const noexcept {
    return waiting_.empty() ? std::numeric_limits<double>::infinity()
                            : waiting_.begin()->first.first;
  }

 private:
  struct Change {
    Key key;
    int batch;
    bool added;
  };
  Waiting waiting_;
  std::int64_t added_ = 0;
  std::vector<Change> changes_;  // of this instant
};

}  // namespace saltus
