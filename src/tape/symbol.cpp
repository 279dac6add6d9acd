#include "saltus/tape/symbol.hpp"

#include <vector>

namespace saltus::tape {

Symbol Symbol::apply(Op op, std::initializer_list<Symbol> operands) {
  Graph constants;  // of constants alone nothing is left but a number
  Graph* graph = &constants;
  for (const Symbol& symbol : operands) {
    if (symbol.graph_ != nullptr) graph = symbol.graph_;
  }
  std::vector<Node> nodes;
  for (const Symbol& symbol : operands) nodes.push_back(symbol.in(*graph));
  const Node result = graph->apply(op, nodes);
  return graph == &constants ? Symbol(*constants.value(result)) : Symbol(*graph, result);
}

}  // namespace saltus::tape
