// Lists: many short lists in two arrays, one list for each number.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"

namespace saltus::detail {

/// The followers of each number, from pairs (number, follower) in any order. A list has the order
/// of its pairs.
class Lists {
 public:
  Lists() = default;
  Lists(std::size_t numbers, const std::vector<std::pair<int, int>>& pairs)
      : start_(numbers + 1, 0), all_(pairs.size()) {
    for (const auto& [number, follower] : pairs) ++start_[number + 1];
    for (std::size_t i = 0; i < numbers; ++i) start_[i + 1] += start_[i];
    List<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const auto& [number, follower] : pairs) all_[next[number]++] = follower;
  }

  std::span<const int> operator[](int number) const {
    const std::size_t first = start_[number];
    return {all_.data() + first, start_[number + 1] - first};
  }

 private:
  List<std::size_t> start_ = {0};
  std::vector<int> all_;
};

}  // namespace saltus::detail
