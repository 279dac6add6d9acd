#include "saltus/plan/detail/flow_divisors.hpp"

#include "saltus/plan/detail/flow_graph.hpp"
#include "saltus/plan/detail/kept.hpp"
#include "saltus/tape/divisors.hpp"

namespace saltus {

std::shared_ptr<const FlowDivisors> flow_divisors(const Plan& plan) {
  return plan.divisors->get([&] {
    FlowDivisors made;
    FlowGraph flow = flow_graph(plan);
    const auto found = tape::divisors(flow.graph, flow.rates);
    if (!found.empty()) made.values.emplace(flow.graph, found);
    return made;
  });
}

}  // namespace saltus
