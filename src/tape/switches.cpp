// The switches of expressions: comparisons, and functions with a kink or a jump.
#include "saltus/tape/switches.hpp"

#include <utility>
#include <vector>

#include "saltus/base/list.hpp"

namespace saltus::tape {

namespace {

class Switches {
 public:
  explicit Switches(Graph& graph) : graph_(graph) {}

  std::vector<Node> of(std::span<const Node> rows) {
    std::vector<char> seen(static_cast<std::size_t>(graph_.size()), 0);
    std::vector<Node> open(rows.begin(), rows.end());
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      if (std::exchange(nth(seen, node.id), char{1})) continue;
      const Expression of = graph_[node];  // a copy: `look` adds nodes
      look(node, of);
      open.insert(open.end(), of.operands.begin(), of.operands.begin() + operand_count(of.op));
    }
    return std::move(found_);
  }

 private:
  void look(Node node, const Expression& of) {
    const auto& [a, b, c] = of.operands;
    switch (of.op) {
      case Op::lt:
      case Op::le:
      case Op::gt:
      case Op::ge:
      case Op::eq:
      case Op::ne:
        return add(a, b, node), poles(a), poles(b);
      case Op::minimum:
      case Op::maximum:
        return add(a, b, graph_.binary(Op::lt, a, b));
      case Op::abs:
        return add_sign(a);
      case Op::sign:
        return add(a, zero(), node), poles(a);
      case Op::copysign:
        return add_sign(a), add_sign(b), poles(b);
      case Op::hypot:  // its kink is a point, which has no sides
        return add(graph_.binary(Op::hypot, a, b), zero(), zero());
      case Op::atan2:
        return add_sign(a);
      case Op::atan:
      case Op::tanh:
        return poles(a);
      default:
        return look_at_steps(node, of);
    }
  }
  void look_at_steps(Node node, const Expression& of) {
    const auto& [a, b, c] = of.operands;
    switch (of.op) {
      case Op::floor:
      case Op::ceil:
      case Op::trunc:
        return add(a, graph_.unary(Op::rint, a), node), poles(a);
      case Op::rint:  // its jumps are between the whole numbers
        return add(graph_.unary(Op::abs, graph_.binary(Op::sub, a, node)), graph_.constant(0.5),
                   node),
               poles(a);
      case Op::mod:
      case Op::fmod:
      case Op::floor_divide: {
        const Node quotient = graph_.binary(Op::div, a, b);
        const Node whole = of.op == Op::floor_divide
                               ? node
                               : graph_.binary(Op::div, graph_.binary(Op::sub, a, node), b);
        return add(quotient, graph_.unary(Op::rint, quotient), graph_.unary(Op::rint, whole)),
               poles(a);
      }
      default:
        return;
    }
  }

  /// Where an expression goes to infinity and comes back from the other side, a function of it that has
  /// bounds jumps, as atan(tan(a)) or sign(1 / a).
  void poles(Node of) {
    std::vector<Node> open{of};
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      if (seen_by_poles(node)) continue;
      const Expression at = graph_[node];  // a copy: `add_sign` adds nodes
      if (at.op == Op::tan) add_sign(graph_.unary(Op::cos, at.operands[0]));
      if (at.op == Op::div && moves(at.operands[1])) add_sign(at.operands[1]);
      if (at.op == Op::pow && moves(at.operands[0])) add_sign(at.operands[0]);
      open.insert(open.end(), at.operands.begin(), at.operands.begin() + operand_count(at.op));
    }
  }
  bool seen_by_poles(Node node) {
    if (seen_by_poles_.size() <= static_cast<std::size_t>(node.id))
      seen_by_poles_.resize(static_cast<std::size_t>(graph_.size()), 0);
    return std::exchange(nth(seen_by_poles_, node.id), char{1}) != 0;
  }
  /// Whether an expression may change between two instants.
  bool moves(Node of) const {
    std::vector<Node> open{of};
    std::vector<char> seen(static_cast<std::size_t>(graph_.size()), 0);
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      if (std::exchange(nth(seen, node.id), char{1})) continue;
      const Expression& at = graph_[node];
      if (at.op == Op::time || at.op == Op::continuous_state) return true;
      open.insert(open.end(), at.operands.begin(), at.operands.begin() + operand_count(at.op));
    }
    return false;
  }

  Node zero() { return graph_.constant(0.0); }
  void add(Node a, Node b, Node branch) {
    found_.insert(found_.end(), {a, b, graph_.binary(Op::add, terms(a), terms(b)), branch});
  }
  void add_sign(Node a) { add(a, zero(), graph_.binary(Op::lt, a, zero())); }
  Node terms(Node a) {
    const Expression of = graph_[a];
    const bool sum = of.op == Op::sub || of.op == Op::add;
    const auto size = [&](Node node) { return graph_.unary(Op::abs, node); };
    return sum ? graph_.binary(Op::add, size(of.operands[0]), size(of.operands[1])) : size(a);
  }

  Graph& graph_;
  std::vector<char> seen_by_poles_;
  std::vector<Node> found_;
};

}  // namespace

std::vector<Node> switches_of(Graph& graph, std::span<const Node> rows) {
  return Switches(graph).of(rows);
}

}  // namespace saltus::tape
