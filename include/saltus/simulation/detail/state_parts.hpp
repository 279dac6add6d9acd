// StateParts: the parts of the continuous state that rest together, as lists of entries.
#pragma once

#include <deque>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

/// Owns the lists of the entries of x that rest with a guard: all of a leaf, or some of them. A list
/// is valid as long as its owner.
class StateParts {
 public:
  explicit StateParts(const Plan& plan) : all_(plan.nx) {
    std::iota(all_.begin(), all_.end(), Index{0});
  }

  /// All states of a leaf.
  std::span<const Index> whole(const PlanLeaf& leaf) const {
    const Index* first = all_.data() + leaf.x;
    return {first, first + leaf.nx};
  }
  /// Some states of a leaf, by their positions in it.
  std::span<const Index> choose(const PlanLeaf& leaf, const std::vector<int>& entries) {
    std::vector<Index>& chosen = chosen_.emplace_back();
    for (const int i : entries) chosen.push_back(leaf.x + i);
    return chosen;
  }
  /// The values of a list: in place where it is that of a whole leaf, otherwise in `room`.
  Eigen::Ref<const Eigen::VectorXd> gather(std::span<const Index> entries, const Eigen::VectorXd& x,
                                           Eigen::VectorXd& room) const {
    const auto size = static_cast<Index>(entries.size());
    const Index first = size > 0 ? entries.front() : 0;
    if (entries.data() == all_.data() + first) return x.segment(first, size);
    room.resize(size);
    for (Index i = 0; i < size; ++i) room[i] = x[entries[static_cast<std::size_t>(i)]];
    return room;
  }

 private:
  List<Index> all_;  // 0, 1, 2, ...; a leaf has its part of them
  std::deque<std::vector<Index>> chosen_;
};

}  // namespace saltus
