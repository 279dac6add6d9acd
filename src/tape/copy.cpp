#include "copy.hpp"
#include "saltus/base/list.hpp"

#include <utility>

namespace saltus::tape {

std::vector<Node> needed(const Graph& graph, std::span<const Node> outputs) {
  std::vector<Node> order;
  enum : char { unseen, entered, done };
  List<char> state(graph.size(), unseen);
  std::vector<Node> open;  // depth first, without recursion: expressions may be deep
  for (const Node output : outputs) {
    open.push_back(output);
    while (!open.empty()) {
      const Node node = open.back();
      const Expression& e = graph[node];
      char& seen = state[node.id];
      if (seen != unseen) {
        open.pop_back();
        if (std::exchange(seen, done) == entered) order.push_back(node);
        continue;
      }
      seen = entered;
      for (int i = operand_count(e.op) - 1; i >= 0; --i) {
        const Node operand = nth(e.operands, i);
        if (state[operand.id] == unseen) open.push_back(operand);
      }
    }
  }
  return order;
}

std::vector<Node> copy(const Graph& from, std::span<const Node> outputs, Graph& to) {
  List<Node> renamed(from.size());
  const auto of = [&](Node node) -> Node& { return renamed[node.id]; };
  for (const Node node : needed(from, outputs)) {
    const Expression& e = from[node];
    switch (e.op) {
      case Op::constant:
        of(node) = to.constant(e.value);
        break;
      case Op::time:
        of(node) = to.time();
        break;
      case Op::continuous_state:
        of(node) = to.continuous_state(e.index);
        break;
      case Op::discrete_state:
        of(node) = to.discrete_state(e.index);
        break;
      case Op::mode:
        of(node) = to.mode();
        break;
      case Op::entry:
        of(node) = to.entry();
        break;
      case Op::parameter:
        of(node) = to.parameter(e.index);
        break;
      case Op::input:
        of(node) = to.input(e.port, e.index);
        break;
      default: {
        std::array<Node, 3> operands{};
        const auto count = static_cast<std::size_t>(operand_count(e.op));
        for (std::size_t i = 0; i < count; ++i) operands[i] = of(e.operands[i]);
        of(node) = to.apply(e.op, {operands.data(), count});
      }
    }
  }
  std::vector<Node> result;
  for (const Node output : outputs) result.push_back(of(output));
  return result;
}

}  // namespace saltus::tape
