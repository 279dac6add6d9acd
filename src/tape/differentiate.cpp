// Forward and reverse accumulation on the graph.
#include <algorithm>
#include <numeric>
#include <optional>

#include "copy.hpp"
#include "partials.hpp"
#include "saltus/base/list.hpp"
#include "saltus/tape/jacobian.hpp"

namespace saltus::tape {

namespace {

using Values = std::vector<std::optional<Node>>;  // for each node, unless it is zero

class Accumulation {
 public:
  Accumulation(Graph& graph, std::span<const Node> outputs, std::span<const Node> variables)
      : graph_(graph), outputs_(outputs), variables_(variables) {
    for (const Node node : variables_) (void)graph_[node];  // each node must exist
    for (const Node node : outputs_) (void)graph_[node];
    const int size = graph_.size();
    needed_.resize(size);
    readers_.resize(size);
    part_.resize(size);
    seen_.assign(size, -1);
    values_.resize(size);
    rows_.resize(size);
    columns_.resize(size);
    for (std::size_t i = 0; i < outputs_.size(); ++i) rows_[index(outputs_[i])].push_back(i);
    for (std::size_t j = 0; j < variables_.size(); ++j) columns_[index(variables_[j])].push_back(j);
    const auto order = needed(graph_, outputs_);
    for (const Node node : order) {
      needed_[index(node)] = true;
      for (const Node operand : operands(node)) readers_[index(operand)].push_back(node);
    }
    connect(order);
  }

  std::vector<Partial> run() {
    const auto [forward, reverse] = costs();
    for (std::size_t j = 0; j < variables_.size(); ++j) {
      const std::size_t part = part_of(variables_[j]);
      if (forward[part] <= reverse[part] || chooses_[part]) column(j);
    }
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      const std::size_t part = part_of(outputs_[i]);
      if (forward[part] > reverse[part] && !chooses_[part]) row(i);
    }
    std::ranges::sort(result_, {}, [](const Partial& p) { return std::pair(p.column, p.row); });
    return std::move(result_);
  }

 private:
  static std::size_t index(Node node) { return static_cast<std::size_t>(node.id); }
  std::vector<Node> operands(Node node) const {
    const Expression& e = graph_[node];
    return {e.operands.begin(), e.operands.begin() + operand_count(e.op)};
  }

  /// Finds parts of the graph that share nothing, by a union-find over the nodes that depend on
  /// variables.
  void connect(const std::vector<Node>& order) {
    std::iota(part_.begin(), part_.end(), std::size_t{0});
    is_active_.assign(part_.size(), false);
    chooses_.assign(part_.size(), false);
    for (const Node node : variables_) is_active_[index(node)] = needed_[index(node)];
    for (const Node node : order) {
      for (const Node operand : operands(node)) {
        if (!is_active_[index(operand)]) continue;
        is_active_[index(node)] = true;
        part_[part_of(operand)] = part_of(node);
      }
    }
    for (const Node node : order) {
      if (is_active_[index(node)] && chooses(graph_[node].op)) chooses_[part_of(node)] = true;
    }
  }
  std::size_t part_of(Node node) {
    std::size_t i = index(node);
    while (part_[i] != i) i = part_[i] = part_[part_[i]];
    return i;
  }

  /// The nodes that depend on a node, including the node, operands first.
  std::vector<Node> dependents(Node from) {
    return reached(from,
                   [this](Node node) { return std::span<const Node>(readers_[index(node)]); });
  }
  /// The nodes that a node depends on and that depend on a variable, operands first.
  std::vector<Node> sources(Node from) {
    if (!is_active_[index(from)]) return {};
    return reached(from, [this](Node node) {
      auto all = operands(node);
      std::erase_if(all, [this](Node operand) { return !is_active_[index(operand)]; });
      return all;
    });
  }
  template <class Next>
  std::vector<Node> reached(Node from, const Next& next) {
    if (!needed_[index(from)]) return {};
    ++visit_;
    std::vector<Node> all{from};
    seen_[index(from)] = visit_;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const Node node : next(all[i])) {
        if (std::exchange(seen_[index(node)], visit_) != visit_) all.push_back(node);
      }
    }
    std::ranges::sort(all);
    return all;
  }

  /// The number of nodes that each direction visits, by part of the graph.
  std::pair<std::vector<std::size_t>, std::vector<std::size_t>> costs() {
    std::vector<std::size_t> forward(part_.size()), reverse(part_.size());
    for (const Node node : variables_) forward[part_of(node)] += dependents(node).size();
    for (const Node node : outputs_) reverse[part_of(node)] += sources(node).size();
    return {std::move(forward), std::move(reverse)};
  }

  bool is_zero(std::optional<Node> value) const { return !value || graph_.value(*value) == 0.0; }
  Node or_zero(std::optional<Node> value) { return value ? *value : graph_.constant(0.0); }
  void add_to(std::optional<Node>& sum, std::optional<Node> term) {
    if (is_zero(term)) return;
    sum = is_zero(sum) ? term : graph_.binary(Op::add, *sum, *term);
  }
  std::optional<Node> times(std::optional<Node> factor, Node value) {
    if (is_zero(factor)) return {};
    return graph_.binary(Op::mul, *factor, value);
  }

  void column(std::size_t j) {
    const auto active = dependents(variables_[j]);
    for (const Node node : active) {
      values_[index(node)] = node == variables_[j] ? graph_.constant(1.0) : tangent(node);
    }
    for (const Node node : active) {
      for (const std::size_t i : rows_[index(node)]) keep(i, j, values_[index(node)]);
    }
    for (const Node node : active) values_[index(node)].reset();
  }

  std::optional<Node> tangent(Node node) {
    const Expression e = graph_[node];
    if (chooses(e.op)) return chosen(e);
    std::optional<Node> sum;
    for (std::size_t k = 0; k < static_cast<std::size_t>(operand_count(e.op)); ++k) {
      const auto inner = values_[index(e.operands[k])];
      if (!is_zero(inner)) add_to(sum, times(partial(graph_, node, k), *inner));
    }
    return sum;
  }

  /// The tangent of the chosen value. It is no product with 0 or 1, because the other value may be
  /// NaN.
  std::optional<Node> chosen(const Expression& e) {
    const bool select = e.op == Op::select;
    const Node a = e.operands[select ? 1 : 0], b = e.operands[select ? 2 : 1];
    const auto of_a = values_[index(a)], of_b = values_[index(b)];
    if (is_zero(of_a) && is_zero(of_b)) return {};
    const Node first = select                ? e.operands[0]
                       : e.op == Op::minimum ? graph_.binary(Op::le, a, b)
                                             : graph_.binary(Op::ge, a, b);
    return graph_.select(first, or_zero(of_a), or_zero(of_b));
  }

  void row(std::size_t i) {
    auto active = sources(outputs_[i]);
    if (active.empty()) return;
    values_[index(outputs_[i])] = graph_.constant(1.0);
    for (auto node = active.rbegin(); node != active.rend(); ++node) hand_on(*node);
    for (const Node node : active) {
      for (const std::size_t j : columns_[index(node)]) keep(i, j, values_[index(node)]);
    }
    for (const Node node : active) values_[index(node)].reset();
  }

  void hand_on(Node node) {
    const auto value = values_[index(node)];
    if (is_zero(value)) return;
    const auto all = operands(node);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!is_active_[index(all[k])]) continue;
      add_to(values_[index(all[k])], times(partial(graph_, node, k), *value));
    }
  }

  void keep(std::size_t i, std::size_t j, std::optional<Node> value) {
    if (is_zero(value)) return;
    result_.push_back({static_cast<Index>(i), static_cast<Index>(j), *value});
  }

  Graph& graph_;
  std::span<const Node> outputs_, variables_;
  std::vector<bool> needed_, is_active_, chooses_;
  std::vector<std::vector<Node>> readers_;
  std::vector<std::vector<std::size_t>> rows_, columns_;  ///< its numbers
  std::vector<std::size_t> part_;
  std::vector<int> seen_;
  int visit_ = 0;
  Values values_;
  std::vector<Partial> result_;
};

}  // namespace

std::vector<Partial> differentiate(Graph& graph, std::span<const Node> outputs,
                                   std::span<const Node> variables) {
  return Accumulation(graph, outputs, variables).run();
}

Jacobian jacobian(const Tape& tape) {
  Graph graph = tape.graph();
  std::vector<Node> states;
  for (int id = 0; id < graph.size(); ++id) {
    if (graph[Node{id}].op == Op::continuous_state) states.push_back({id});
  }
  std::ranges::sort(states, {}, [&](Node state) { return graph[state].index; });
  const auto index = [&](Index j) { return graph[nth(states, j)].index; };
  std::vector<MatrixEntry> entries;
  std::vector<Node> values;
  for (const Partial& partial : differentiate(graph, tape.outputs(), states)) {
    entries.push_back({partial.row, index(partial.column)});
    values.push_back(partial.value);
  }
  return {std::move(entries), Tape(graph, values)};
}

}  // namespace saltus::tape
