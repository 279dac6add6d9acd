#include <algorithm>
#include <iterator>

#include "../copy.hpp"
#include "saltus/tape/series.hpp"

namespace saltus::tape {

namespace {

/// The operations with a jump or a kink that are no comparisons.
constexpr Op kinked[] = {Op::abs,      Op::floor,   Op::ceil,  Op::trunc,        Op::rint,
                         Op::sign,     Op::mod,     Op::fmod,  Op::floor_divide, Op::minimum,
                         Op::copysign, Op::maximum, Op::select};

bool is_smooth(Op op) { return !is_truth(op) && std::ranges::find(kinked, op) == std::end(kinked); }

}  // namespace

std::vector<Op> kinks(const Graph& graph, std::span<const Node> nodes) {
  std::vector<bool> varies(static_cast<std::size_t>(graph.size()), false);
  std::vector<Op> found;
  for (const Node node : needed(graph, nodes)) {
    const Expression& e = graph[node];
    bool any = e.op == Op::time || e.op == Op::continuous_state;
    for (int k = 0; k < operand_count(e.op); ++k) {
      any = any || varies[static_cast<std::size_t>(e.operands[static_cast<std::size_t>(k)].id)];
    }
    varies[static_cast<std::size_t>(node.id)] = any;
    // a select whose condition is constant has one branch
    const bool turns =
        e.op == Op::select ? varies[static_cast<std::size_t>(e.operands[0].id)] : any;
    if (turns && !is_smooth(e.op)) found.push_back(e.op);
  }
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

}  // namespace saltus::tape
