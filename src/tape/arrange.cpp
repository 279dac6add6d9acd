#include "arrange.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "copy.hpp"

namespace saltus::tape::detail {

namespace {

/// The array that contains a number, and its place there: the state, for example, or the results of
/// a run. A number in no array is its own array.
struct Where {
  int array = 0;
  Index position = 0;
};

class Arranger {
 public:
  explicit Arranger(const Graph& graph) : graph_(graph) {
    const int size = graph.size();
    swapped_.assign(size, false);
    where_.resize(size);
    level_.assign(size, 0);
  }

  Arrangement run(const std::vector<Node>& order) {
    for (const Node node : order) note(node);
    for (auto& [key, nodes] : buckets_) split(key.second, nodes);
    if (!any_run_) {  // depth first: the operand is often the last value computed
      groups_.clear(), joined_.clear();
      for (const Node node : order) {
        if (operand_count(graph_[node].op) > 0) groups_.push_back({node});
      }
    }
    return {std::move(groups_), std::move(swapped_), std::move(joined_)};
  }

 private:
  static std::size_t index(Node node) { return static_cast<std::size_t>(node.id); }
  std::span<const Node> operands(Node node) const {
    const Expression& e = graph_[node];
    return {e.operands.data(), static_cast<std::size_t>(operand_count(e.op))};
  }

  /// Nodes of one level do not need each other: the level is 1 + the highest level of the operands.
  void note(Node node) {
    const Expression& e = graph_[node];
    where_[index(node)] = {-1 - node.id, 0};
    if (e.op == Op::continuous_state) where_[index(node)] = {new_array(0), e.index};
    if (e.op == Op::discrete_state) where_[index(node)] = {new_array(1), e.index};
    if (e.op == Op::parameter) where_[index(node)] = {new_array(2), e.index};
    if (e.op == Op::input) where_[index(node)] = {new_array(3 + e.port), e.index};
    if (operand_count(e.op) == 0) return;
    int& level = level_[index(node)];
    for (const Node operand : operands(node)) level = std::max(level, level_[index(operand)] + 1);
    buckets_[{level, e.op}].push_back(node);
  }

  /// Arrays of variables have the first numbers; arrays of runs are numbered after the largest
  /// port.
  int new_array(int number) {
    arrays_ = std::max(arrays_, number + 1);
    return number;
  }

  const Where& where(Node node, std::size_t k) const {
    const bool swap = swapped_[index(node)];
    return where_[index(operands(node)[swap ? 1 - k : k])];
  }

  using Order = std::tuple<std::array<int, 3>, std::array<Index, 3>, Node>;
  Order order(Node node) const {
    Order result{{}, {}, node};
    for (std::size_t k = 0; k < operands(node).size(); ++k) {
      std::get<0>(result)[k] = where(node, k).array;
      std::get<1>(result)[k] = where(node, k).position;
    }
    return result;
  }

  /// Cuts nodes of one level and one operation into runs and single nodes.
  void split(Op op, std::vector<Node>& nodes) {
    if (nodes.size() >= shortest_run) {
      for (const Node node : nodes) {
        swapped_[index(node)] = is_commutative(op) && where(node, 1).array < where(node, 0).array;
      }
      std::vector<Order> sorted;
      for (const Node node : nodes) sorted.push_back(order(node));
      std::ranges::sort(sorted);
      std::ranges::transform(sorted, nodes.begin(), [](const Order& o) { return std::get<2>(o); });
    }
    for (std::size_t first = 0; first < nodes.size();) {
      std::size_t length = run_length({nodes.begin() + static_cast<Index>(first), nodes.end()});
      if (length < shortest_run) length = 1;
      any_run_ = any_run_ || length > 1;
      const auto begin = nodes.begin() + static_cast<Index>(first);
      groups_.emplace_back(begin, begin + static_cast<Index>(length));
      first += length;
    }
    if (nodes.size() >= shortest_run) join(nodes);
  }

  /// Gives all nodes of an array places side by side.
  void join(const std::vector<Node>& nodes) {
    const int array = arrays_++;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      where_[index(nodes[i])] = {array, static_cast<Index>(i)};
    joined_.push_back(nodes);
  }

  std::size_t run_length(std::span<const Node> nodes) const {
    if (nodes.size() < 2) return nodes.size();
    const auto steps = [&](std::size_t i) {
      std::array<Index, 3> step{};
      for (std::size_t k = 0; k < operands(nodes[0]).size(); ++k) {
        const Where &a = where(nodes[i], k), &b = where(nodes[i + 1], k);
        step[k] = a.array == b.array ? b.position - a.position : no_step;
      }
      return step;
    };
    const auto first = steps(0);
    if (std::ranges::find(first, no_step) != first.end()) return 1;
    std::size_t length = 2;
    while (length < nodes.size() && steps(length - 1) == first) ++length;
    return length;
  }
  static constexpr Index no_step = -(Index{1} << 60);

  const Graph& graph_;
  std::vector<bool> swapped_;
  std::vector<std::vector<Node>> joined_;
  std::vector<Where> where_;
  std::vector<int> level_;
  std::map<std::pair<int, Op>, std::vector<Node>> buckets_;
  std::vector<Group> groups_;
  int arrays_ = 3;
  bool any_run_ = false;
};

}  // namespace

Arrangement arrange(const Graph& graph, std::span<const Node> outputs) {
  return Arranger(graph).run(needed(graph, outputs));
}

}  // namespace saltus::tape::detail
