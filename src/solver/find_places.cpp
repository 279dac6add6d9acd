// Groups of arguments are halved, and calls find which half a value reads.
#include "saltus/solver/detail/find_places.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <numeric>

#include "saltus/solver/detail/colouring.hpp"
#include "saltus/solver/detail/linear_thresholds.hpp"

namespace saltus {

namespace {

/// Groups of neighbours, `size` arguments each, and the values that read some of them.
class Groups {
 public:
  /// The first groups: one group that every value may read.
  explicit Groups(Index n) : n_(n), members_{0} {
    while (size_ < n) size_ *= 2;
    read_by_.rows.resize(n);
    std::iota(read_by_.rows.begin(), read_by_.rows.end(), 0);
    read_by_.start.push_back(n);
  }

  Index size() const { return size_; }
  /// The places, once each group is one argument: column j belongs to argument j.
  Sparsity places() const {
    Sparsity all;
    std::size_t group = 0;
    for (int j = 0; j < n_; ++j) {
      if (group < members_.size() && members_[group] == j) {
        const auto values = read_by_.column(static_cast<Index>(group++));
        all.rows.insert(all.rows.end(), values.begin(), values.end());
      }
      all.start.push_back(all.size());
    }
    return all;
  }

  bool looks_full() const {
    const Index groups = read_by_.columns();
    return groups >= thresholds::judged_groups && 2 * read_by_.size() > groups * n_;
  }

  /// Colours the groups: no value reads two groups of one colour.
  Colouring apart() const {
    return colour({.places = read_by_,
                   .own = {},
                   .differences = std::vector<char>(read_by_.rows.size(), 1),
                   .overflow = false});
  }

  /// Splits every group in two. Drops a value that reads neither half, and a half that no value
  /// reads.
  Groups halved(const Colouring& together, const Response& response, int& calls) const {
    List<std::vector<int>> halves(2 * read_by_.columns());
    std::vector<int> moved;
    List<char> changed(n_);
    for (Index c = 0; c < together.colours(); ++c) {
      for (const std::size_t half : {0, 1}) {
        moved.clear();
        for (const int group : together.of(c)) add_half(group, half, moved);
        if (moved.empty()) continue;
        response(moved, changed), ++calls;
        for (const int group : together.of(c))
          std::ranges::copy_if(read_by_.column(group), std::back_inserter(halves[2 * group + half]),
                               [&](int value) { return changed[value] != 0; });
      }
    }
    return {*this, halves};
  }

 private:
  Groups(const Groups& before, const std::vector<std::vector<int>>& halves)
      : n_(before.n_), size_(before.size_ / 2) {
    for (std::size_t k = 0; k < halves.size(); ++k) {
      if (halves[k].empty()) continue;
      members_.push_back(before.members_[k / 2] + (k % 2 == 0 ? 0 : static_cast<int>(size_)));
      read_by_.rows.insert(read_by_.rows.end(), halves[k].begin(), halves[k].end());
      read_by_.start.push_back(read_by_.size());
    }
  }

  void add_half(int group, std::size_t half, std::vector<int>& to) const {
    const Index first = members_[group] + (half == 0 ? Index{0} : size_ / 2);
    for (Index j = first; j < std::min(first + size_ / 2, n_); ++j)
      to.push_back(static_cast<int>(j));
  }

  Index n_, size_ = 2;
  List<int> members_;  // the first argument of each group
  Sparsity read_by_;   // column k: the values that read group k
};

}  // namespace

Places find_places(Index n, const Response& response) {
  Places result;
  Groups groups(n);
  while (groups.size() > 1) {
    const Colouring together = groups.apart();
    if (groups.looks_full())
      result.search = Search::full;
    else if (together.colours() > thresholds::most_colours)
      result.search = Search::dear;
    if (result.search != Search::found) return result;
    groups = groups.halved(together, response, result.calls);
  }
  result.places = groups.places();
  return result;
}

}  // namespace saltus
