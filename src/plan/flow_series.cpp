#include "saltus/plan/detail/flow_series.hpp"

#include "saltus/plan/detail/flow_graph.hpp"
#include "saltus/plan/detail/kept.hpp"

namespace saltus {

namespace {

/// The first reason why the derivatives have no series.
std::string obstacle_of(const FlowGraph& flow) {
  if (!flow.obstacle.empty())
    return text(
        flow.obstacle,
        " is called, so it has no series; it needs a traced function, or equations<N> in C++");
  const auto kinks = tape::kinks(flow.graph, flow.rates);
  if (kinks.empty()) return {};
  return text(
      "a derivative uses '", tape::name(kinks.front()),
      "' of a state or of the time: it has a kink or a jump that no guard locates, and needs a "
      "mode for each branch");
}

/// Whether the series of a guard shows its crossings.
bool shows(const FlowGraph& flow, tape::Node guard) {
  const std::span<const tape::Node> alone(&guard, 1);
  return tape::kinks(flow.graph, alone).empty() && !tape::may_hide(flow.graph, alone);
}

FlowSeries made_of(const FlowGraph& flow) {
  FlowSeries made;
  made.obstacle = obstacle_of(flow);
  if (!made.obstacle.empty()) return made;
  std::vector<tape::Node> outputs;
  for (const auto& guard : flow.guards) {
    const bool shown = guard && shows(flow, *guard);
    made.output_of_slot.push_back(shown ? static_cast<int>(outputs.size()) : FlowSeries::no_output);
    if (shown) outputs.push_back(*guard);
  }
  made.hides = tape::may_hide(flow.graph, flow.rates);
  made.series.emplace(flow.graph, flow.rates, outputs);
  return made;
}

}  // namespace

std::shared_ptr<const FlowSeries> flow_series(const Plan& plan) {
  return plan.series->get([&] { return made_of(flow_graph(plan)); });
}

}  // namespace saltus
