// StateWrites: how many reset maps of an instant wrote the continuous states of each leaf.
#pragma once

#include <algorithm>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

/// Counts the reset maps of an instant that wrote the continuous state of a leaf.
class StateWrites {
 public:
  explicit StateWrites(std::size_t leaves) : counts_(leaves, 0) {}

  /// An instant begins.
  void clear() {
    if (any_) std::ranges::fill(counts_, 0);
    any_ = false;
  }
  void add(int leaf) { ++counts_[leaf], any_ = true; }

  int of(int leaf) const { return counts_[leaf]; }
  /// How many reset maps wrote a continuous state that changes a guard. Other reset maps say nothing
  /// about the flow of this guard.
  int of(const GuardGroup& guard) const {
    if (!any_) return 0;
    int sum = 0;
    for (const int leaf : guard.leaves) sum += counts_[leaf];
    return sum;
  }

 private:
  List<int> counts_;  // of each leaf
  bool any_ = false;  // some count is not zero
};

}  // namespace saltus
