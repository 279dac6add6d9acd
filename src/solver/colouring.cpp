// Greedy colouring of the columns of a Jacobian.
#include "saltus/solver/detail/colouring.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <numeric>

namespace saltus {

namespace {

/// The rows that differences have to find, with all their columns, and the columns to colour.
class SoughtRows {
 public:
  explicit SoughtRows(const JacobianPattern& pattern) : columns_of_(rows_of(pattern)) {
    const Sparsity& places = pattern.places;
    for (Index j = 0; j < places.columns(); ++j) {
      const auto first = places.start[j], last = places.start[j + 1];
      if (std::any_of(pattern.differences.begin() + first, pattern.differences.begin() + last,
                      [](char differs) { return differs != 0; }))
        to_colour_.push_back(static_cast<int>(j));
    }
  }

  const std::vector<int>& to_colour() const { return to_colour_; }
  std::size_t fullest() const {
    std::size_t most = 0;
    for (const auto& row : columns_of_) most = std::max(most, row.size());
    return most;
  }

  /// Colour of each column, or -1 for none. Each column takes the first free colour, in this order.
  List<int> greedy(const Sparsity& places, const std::vector<int>& order) const {
    List<int> colour(places.columns(), -1);
    List<int> taken_by(order.size() + 1, -1);  // by colour: the last column beside it
    for (const int j : order) {
      for (const int row : places.column(j)) {
        for (const int other : columns_of_[row]) {
          const int seen = colour[other];
          if (seen >= 0) taken_by[seen] = j;
        }
      }
      const auto free = std::ranges::find_if(taken_by, [j](int by) { return by != j; });
      colour[j] = static_cast<int>(free - taken_by.begin());
    }
    return colour;
  }

 private:
  static List<std::vector<int>> rows_of(const JacobianPattern& pattern) {
    const Sparsity& places = pattern.places;
    Index last = places.columns() - 1;
    for (const int row : places.rows) last = std::max(last, Index{row});
    List<std::vector<int>> rows(last + 1);
    List<char> sought(rows.size());
    for (std::size_t k = 0; k < places.rows.size(); ++k)
      if (pattern.differences[k]) sought[places.rows[k]] = 1;
    for (Index j = 0; j < places.columns(); ++j) {
      for (const int row : places.column(j))
        if (sought[row]) rows[row].push_back(static_cast<int>(j));
    }
    return rows;
  }

  List<std::vector<int>> columns_of_;
  std::vector<int> to_colour_;
};

Colouring by_colour(const std::vector<int>& colours) {
  Colouring result;
  const int most = colours.empty() ? -1 : *std::ranges::max_element(colours);
  List<std::vector<int>> lists(most + 1);
  for (std::size_t j = 0; j < colours.size(); ++j)
    if (colours[j] >= 0) lists[colours[j]].push_back(static_cast<int>(j));
  for (const auto& list : lists) {
    result.columns.insert(result.columns.end(), list.begin(), list.end());
    result.start.push_back(static_cast<Index>(result.columns.size()));
  }
  return result;
}

Colouring one_each(const std::vector<int>& columns) {
  Colouring result;
  for (const int j : columns) {
    result.columns.push_back(j);
    result.start.push_back(static_cast<Index>(result.columns.size()));
  }
  return result;
}

}  // namespace

Colouring colour(const JacobianPattern& pattern) {
  const SoughtRows sought(pattern);
  std::vector<int> order = sought.to_colour();
  const std::size_t fullest = sought.fullest();
  if (2 * fullest > order.size()) return one_each(order);
  Colouring natural = by_colour(sought.greedy(pattern.places, order));
  if (natural.colours() <= static_cast<Index>(fullest)) return natural;
  std::ranges::stable_sort(order, std::greater{},
                           [&](int j) { return pattern.places.column(j).size(); });
  Colouring largest_first = by_colour(sought.greedy(pattern.places, order));
  return largest_first.colours() < natural.colours() ? largest_first : natural;
}

}  // namespace saltus
