// Bandwidth and the reverse Cuthill-McKee order.
#include "saltus/solver/detail/ordering.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>

namespace saltus {

namespace {

/// The graph of a matrix: states are neighbours if they share a place.
class Adjacency {
 public:
  explicit Adjacency(const Sparsity& places) : neighbours_(places.columns()) {
    for (int j = 0; j < places.columns(); ++j) {
      for (const int i : places.column(j)) {
        if (i == j) continue;
        neighbours_[i].push_back(j);
        neighbours_[j].push_back(i);
      }
    }
    for (auto& list : neighbours_) {
      std::ranges::sort(list);
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  std::size_t size() const { return neighbours_.size(); }
  const std::vector<int>& of(int i) const { return neighbours_[i]; }
  std::size_t degree(int i) const { return of(i).size(); }

 private:
  List<std::vector<int>> neighbours_;
};

/// Searches breadth first from `root`, neighbours by rising degree, and appends each state to
/// `order`. Returns the index in `order` at which the last level begins.
std::size_t search(const Adjacency& graph, int root, std::vector<char>& met,
                   std::vector<int>& order) {
  std::size_t level = order.size(), next = order.size();
  order.push_back(root), met[root] = 1;
  for (std::size_t level_end = order.size(); next < order.size(); level_end = order.size()) {
    level = next;
    for (; next < level_end; ++next) {
      const std::size_t first = order.size();
      for (const int neighbour : graph.of(order[next])) {
        if (std::exchange(met[neighbour], 1)) continue;
        order.push_back(neighbour);
      }
      std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.end(),
                       [&](int a, int b) { return graph.degree(a) < graph.degree(b); });
    }
  }
  return level;
}

/// A state at the rim of the component of `root`: the least connected of the furthest states.
int rim(const Adjacency& graph, int root, std::vector<char>& met, std::vector<int>& order) {
  for (int rounds = 0; rounds < 2; ++rounds) {
    const auto begin = order.size();
    const auto level = static_cast<std::ptrdiff_t>(search(graph, root, met, order));
    root = *std::min_element(order.begin() + level, order.end(),
                             [&](int a, int b) { return graph.degree(a) < graph.degree(b); });
    for (std::size_t k = begin; k < order.size(); ++k) met[order[k]] = 0;
    order.resize(begin);
  }
  return root;
}

}  // namespace

Bandwidth bandwidth(const Sparsity& places, const std::vector<int>& position) {
  Bandwidth band;
  const auto at = [&](int i) { return position.empty() ? i : position[i]; };
  for (int j = 0; j < places.columns(); ++j) {
    for (const int i : places.column(j)) {
      const Index below = at(i) - at(j);
      band.lower = std::max(band.lower, below), band.upper = std::max(band.upper, -below);
    }
  }
  return band;
}

std::vector<int> reverse_cuthill_mckee(const Sparsity& places) {
  const Adjacency graph(places);
  List<char> met(graph.size());
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(graph.size()); ++i)
    if (!met[i]) search(graph, rim(graph, i, met, order), met, order);
  List<int> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    position[order[k]] = static_cast<int>(order.size() - 1 - k);
  return position;
}

}  // namespace saltus
