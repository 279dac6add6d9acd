// RestingStates: the entries of x whose derivative is zero while they are held.
#pragma once

#include <algorithm>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

/// Counts the holds on each entry of x, and the entries at rest of each leaf.
class RestingStates {
 public:
  explicit RestingStates(const Plan& plan) : holds_(plan.nx, 0), of_leaf_(plan.leaves.size(), 0) {
    for (std::size_t i = 0; i < plan.leaves.size(); ++i)
      leaf_.insert(leaf_.end(), static_cast<std::size_t>(plan.leaves[i].nx), i);
  }

  void clear() {
    std::ranges::fill(holds_, 0), std::ranges::fill(of_leaf_, 0);
    count_ = 0;
  }
  /// Entry i has zero derivative from now on, until `move` was called as often as `rest`.
  void rest(Index i) { change(i, 1); }
  void move(Index i) { change(i, -1); }

  bool any() const noexcept { return count_ > 0; }
  bool rests(Index i) const { return holds_[i] > 0; }
  /// The number of entries of a leaf that rest.
  Index of_leaf(std::size_t leaf) const { return of_leaf_[leaf]; }

 private:
  void change(Index i, int by) {
    int& holds = holds_[i];
    const bool before = holds > 0;
    holds += by;
    const Index change = static_cast<Index>(holds > 0) - static_cast<Index>(before);
    of_leaf_[leaf_[i]] += change, count_ += change;
  }

  List<int> holds_;         // on each entry of x
  List<Index> of_leaf_;     // entries of each leaf that rest
  List<std::size_t> leaf_;  // the leaf of each entry
  Index count_ = 0;         // entries that rest, in total
};

}  // namespace saltus
