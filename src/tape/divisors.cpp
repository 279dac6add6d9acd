#include <algorithm>
#include <optional>

#include "copy.hpp"
#include "saltus/base/list.hpp"
#include "saltus/tape/divisors.hpp"

namespace saltus::tape {

namespace {

/// What is known of the values of an expression.
enum class Sign : char { any, not_negative, positive };

class Search {
 public:
  Search(Graph& graph, std::span<const Node> nodes)
      : graph_(graph), order_(needed(graph, nodes)), sign_(graph.size()), varies_(graph.size()) {
    for (const Node node : order_) read(node);
  }

  std::vector<Node> run() {
    for (const Node node : order_) {
      if (const auto divisor = divisor_of(graph_[node])) add(*divisor);
    }
    std::ranges::sort(found_);
    found_.erase(std::ranges::unique(found_).begin(), found_.end());
    return std::move(found_);
  }

 private:
  void read(Node node) {
    const Expression& e = graph_[node];
    char varies = e.op == Op::time || e.op == Op::continuous_state ? 1 : 0;
    for (int k = 0; k < operand_count(e.op); ++k) {
      const char operand = varies_[nth(e.operands, k).id];
      varies = std::max(varies, operand);
    }
    varies_[node.id] = varies;
    sign_[node.id] = sign_of(e);
  }

  Sign sign(Node node) const { return sign_[node.id]; }
  Sign sign_of(const Expression& e) const {
    const auto [a, b, c] = e.operands;
    switch (e.op) {
      case Op::constant:
        return e.value > 0.0 ? Sign::positive : e.value == 0.0 ? Sign::not_negative : Sign::any;
      case Op::exp:
      case Op::exp2:
      case Op::cosh:
        return Sign::positive;
      case Op::abs:
      case Op::sqrt:
      case Op::hypot:
        return Sign::not_negative;
      case Op::add:
        return std::min(sign(a), sign(b)) == Sign::any ? Sign::any : std::max(sign(a), sign(b));
      case Op::mul:
        return a == b && sign(a) == Sign::any ? Sign::not_negative : std::min(sign(a), sign(b));
      case Op::div:
        return std::min(sign(a), sign(b));
      case Op::pow:
        return sign(a);
      case Op::select:
        return std::min(sign(b), sign(c));
      default:
        return Sign::any;
    }
  }

  /// The part of an expression at whose zero it may be infinite.
  std::optional<Node> divisor_of(const Expression& e) {
    const Node a = e.operands[0], b = e.operands[1];
    if (e.op == Op::div) return b;
    if (e.op == Op::tan && varies(a)) return cosine(a);
    if (e.op == Op::pow && !(graph_.value(b) >= 0.0)) return a;
    return {};
  }
  /// A node that the others need not read.
  Node cosine(Node a) {
    const Node node = graph_.unary(Op::cos, a);
    varies_.resize(static_cast<std::size_t>(graph_.size()));
    sign_.resize(static_cast<std::size_t>(graph_.size()));
    varies_[node.id] = 1;
    return node;
  }
  bool varies(Node node) const { return varies_[node.id] != 0; }

  /// Notes the parts of a divisor that may change their sign.
  void add(Node divisor) {
    std::vector<Node> open{divisor};
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      if (!varies(node)) continue;
      const Expression& e = graph_[node];
      if (e.op == Op::mul) {
        open.push_back(e.operands[1]);
        open.push_back(e.operands[0]);
      } else if (e.op == Op::neg || e.op == Op::abs || e.op == Op::div || e.op == Op::pow) {
        open.push_back(e.operands[0]);
      } else if (sign(node) == Sign::any) {
        found_.push_back(node);
      }
    }
  }

  Graph& graph_;
  std::vector<Node> order_;
  List<Sign> sign_;
  List<char> varies_;
  std::vector<Node> found_;
};

}  // namespace

std::vector<Node> divisors(Graph& graph, std::span<const Node> nodes) {
  return Search(graph, nodes).run();
}

}  // namespace saltus::tape
