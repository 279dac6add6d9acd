#include "saltus/tape/symbol.hpp"

#include <algorithm>
#include <array>

namespace saltus::tape {

namespace {

Node applied(Graph& graph, Op op, std::initializer_list<Symbol> operands) {
  std::array<Node, 4> nodes{};  // no operation takes so many operands: the graph refuses them
  const std::size_t count = std::min(operands.size(), nodes.size());
  std::transform(operands.begin(), operands.begin() + count, nodes.begin(),
                 [&](const Symbol& symbol) { return symbol.in(graph); });
  return graph.apply(op, {nodes.data(), count});
}

}  // namespace

Symbol Symbol::apply(Op op, std::initializer_list<Symbol> operands) {
  Graph* graph = nullptr;
  for (const Symbol& symbol : operands) {
    if (symbol.graph_ != nullptr) graph = symbol.graph_;
  }
  if (graph != nullptr) return {*graph, applied(*graph, op, operands)};
  Graph constants;  // only a number is left of it
  return *constants.value(applied(constants, op, operands));
}

}  // namespace saltus::tape
