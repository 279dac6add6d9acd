// OutsideWires: what an island gets through event wires from other islands, and what it sends to them.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "saltus/plan/event_wires.hpp"

namespace saltus {

/// A delivery that waits in the island of its target. The leaf is one of the island.
struct OutsideDelivery {
  double due;  ///< [s]
  EventWires::Target target;
};

/// An event of an island that other islands get, by the number of its source in the island.
struct OutsideFiring {
  double t;  ///< [s]
  int source;
};

/// The only writer of what waits in an island and of what it has sent. Deliveries may come in any
/// order: they are taken by their due times, then by the order of their wires.
class OutsideWires {
 public:
  void clear() { waiting_.clear(), taken_.clear(), fired_.clear(), before_ = 0; }

  void put(const OutsideDelivery& one) {
    waiting_.push_back(one);
    std::ranges::push_heap(waiting_, is_later);
  }
  /// [s] The first time at which one is due; infinite if none waits.
  double next() const noexcept {
    return waiting_.empty() ? std::numeric_limits<double>::infinity() : waiting_.front().due;
  }

  /// An instant begins: `undo` goes back to here.
  void open() noexcept { taken_.clear(), before_ = fired_.size(); }
  void undo() {
    for (const OutsideDelivery& one : taken_) put(one);
    taken_.clear();
    fired_.resize(before_);
  }
  /// Takes those out that are due at t [s] at the latest, and adds their targets to a list.
  void take(double t, std::vector<EventWires::Target>& arriving) {
    while (next() <= t) {
      std::ranges::pop_heap(waiting_, is_later);
      taken_.push_back(waiting_.back()), waiting_.pop_back();
      arriving.push_back(taken_.back().target);
    }
  }
  void fire(int source, double t) { fired_.push_back({t, source}); }

  /// What the island has sent since the last call of `forget_fired`.
  const std::vector<OutsideFiring>& fired() const noexcept { return fired_; }
  void forget_fired() noexcept { fired_.clear(), before_ = 0; }

 private:
  static bool is_later(const OutsideDelivery& a, const OutsideDelivery& b) {
    return std::pair(a.due, a.target.number) > std::pair(b.due, b.target.number);
  }

  std::vector<OutsideDelivery> waiting_;  // a heap
  std::vector<OutsideDelivery> taken_;    // in this instant
  std::vector<OutsideFiring> fired_;
  std::size_t before_ = 0;  // the number of firings before this instant
};

}  // namespace saltus
