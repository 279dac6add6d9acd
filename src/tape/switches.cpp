// The switches of expressions: comparisons, and functions with a kink or a jump.
#include "saltus/tape/switches.hpp"

#include <utility>

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
      look(of);
      open.insert(open.end(), of.operands.begin(), of.operands.begin() + operand_count(of.op));
    }
    return std::move(found_);
  }

 private:
  void look(const Expression& of) {
    const auto& [a, b, c] = of.operands;
    switch (of.op) {
      case Op::lt:
      case Op::le:
      case Op::gt:
      case Op::ge:
      case Op::eq:
      case Op::ne:
      case Op::minimum:
      case Op::maximum:
        return add(a, b);
      case Op::abs:
      case Op::sign:
        return add(a, zero());
      case Op::copysign:
        return add(a, zero()), add(b, zero());
      case Op::hypot:
        return add(graph_.binary(Op::hypot, a, b), zero());
      case Op::floor:
      case Op::ceil:
      case Op::trunc:
        return add(a, graph_.unary(Op::rint, a));
      case Op::rint:  // its jumps are between the whole numbers
        return add(graph_.unary(Op::abs, graph_.binary(Op::sub, a, graph_.unary(Op::rint, a))),
                   graph_.constant(0.5));
      case Op::mod:
      case Op::fmod:
      case Op::floor_divide: {
        const Node quotient = graph_.binary(Op::div, a, b);
        return add(quotient, graph_.unary(Op::rint, quotient));
      }
      default:
        return;
    }
  }
  Node zero() { return graph_.constant(0.0); }
  void add(Node a, Node b) {
    found_.insert(found_.end(), {a, b, graph_.binary(Op::add, terms(a), terms(b))});
  }
  Node terms(Node a) {
    const Expression of = graph_[a];
    const bool sum = of.op == Op::sub || of.op == Op::add;
    const auto size = [&](Node node) { return graph_.unary(Op::abs, node); };
    return sum ? graph_.binary(Op::add, size(of.operands[0]), size(of.operands[1])) : size(a);
  }

  Graph& graph_;
  std::vector<Node> found_;
};

}  // namespace

std::vector<Node> switches_of(Graph& graph, std::span<const Node> rows) {
  return Switches(graph).of(rows);
}

}  // namespace saltus::tape
