#include <algorithm>
#include <optional>
#include <utility>

#include "copy.hpp"
#include "saltus/base/list.hpp"
#include "saltus/tape/divisors.hpp"
#include "saltus/tape/value_range.hpp"

namespace saltus::tape {

namespace {

constexpr double infinite = ValueRange::infinite;

class DivisorSearch {
 public:
  DivisorSearch(Graph& graph, std::span<const Node> nodes)
      : graph_(graph),
        order_(needed(graph, nodes)),
        range_(graph.size()),
        varies_(graph.size()),
        noted_(graph.size()) {
    for (const Node node : order_) read(node);
  }

  std::vector<Node> run() {
    for (const Node node : order_) {
      if (const auto divisor = divisor_of(graph_[node])) add(*divisor);
    }
    std::ranges::sort(found_);
    return std::move(found_);
  }

 private:
  void read(Node node) {
    const Expression& e = graph_[node];
    char varies = e.op == Op::time ? in_time : e.op == Op::continuous_state ? with_states : 0;
    for (int k = 0; k < operand_count(e.op); ++k) {
      const char operand = varies_[nth(e.operands, k).id];
      varies = std::max(varies, operand);
    }
    varies_[node.id] = varies;
    range_[node.id] = range_of(e);
  }

  const ValueRange& range(Node node) const { return range_[node.id]; }
  ValueRange range_of(const Expression& e) const {
    const auto [a, b, c] = e.operands;
    switch (e.op) {
      case Op::constant:
        return {e.value, e.value};
      case Op::sin:
      case Op::cos:
      case Op::tanh:
      case Op::sign:
        return {-1.0, 1.0};
      case Op::exp:
      case Op::exp2:
      case Op::abs:
      case Op::sqrt:
      case Op::hypot:
        return {0.0, infinite};
      case Op::cosh:
        return {1.0, infinite};
      case Op::neg:
        return -range(a);
      case Op::add:
        return range(a) + range(b);
      case Op::sub:
        return range(a) + -range(b);
      case Op::mul:
        return a == b ? ValueRange{0.0, infinite} : range(a) * range(b);
      case Op::pow:
        return range(a).low >= 0.0 ? ValueRange{0.0, infinite} : ValueRange{};
      case Op::minimum:
        return {std::min(range(a).low, range(b).low), std::min(range(a).high, range(b).high)};
      case Op::maximum:
        return {std::max(range(a).low, range(b).low), std::max(range(a).high, range(b).high)};
      case Op::select:
        return {std::min(range(b).low, range(c).low), std::max(range(b).high, range(c).high)};
      default:
        return {};
    }
  }

  /// The part of an expression at whose zero it may be infinite.
  std::optional<Node> divisor_of(const Expression& e) {
    const Node a = e.operands[0], b = e.operands[1];
    if (e.op == Op::div) return b;
    if (e.op == Op::tan) return cosine(a);
    if (e.op == Op::pow && !(graph_.value(b) >= 0.0)) return a;
    return {};
  }
  /// The node of cos(a). It may be new, and then the tables grow with the graph.
  Node cosine(Node a) {
    const Node node = graph_.unary(Op::cos, a);
    const auto size = static_cast<std::size_t>(graph_.size());
    varies_.resize(size), range_.resize(size), noted_.resize(size);
    varies_[node.id] = varies_[a.id];
    return node;
  }
  /// Whether an expression changes with the time but with no state.
  bool is_of_time(Node node) const { return varies_[node.id] == in_time; }

  /// Notes the parts of a divisor that may change their sign.
  void add(Node divisor) {
    std::vector<Node> open{divisor};
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      if (std::exchange(noted_[node.id], 1) != 0) continue;  // a power by squares has it often
      const Expression& e = graph_[node];
      if (e.op == Op::mul) {
        open.push_back(e.operands[1]);
        open.push_back(e.operands[0]);
      } else if (e.op == Op::neg || e.op == Op::abs || e.op == Op::div || e.op == Op::pow) {
        open.push_back(e.operands[0]);
      } else if (is_of_time(node) && range(node).changes_sign()) {
        found_.push_back(node);
      }
    }
  }

  static constexpr char in_time = 1, with_states = 2;

  Graph& graph_;
  std::vector<Node> order_;
  List<ValueRange> range_;
  List<char> varies_, noted_;
  std::vector<Node> found_;
};

}  // namespace

std::vector<Node> divisors(Graph& graph, std::span<const Node> nodes) {
  return DivisorSearch(graph, nodes).run();
}

}  // namespace saltus::tape
