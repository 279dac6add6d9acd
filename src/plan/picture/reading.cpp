// Finds the readers of each input, and the rate of each value in the plan.
#include "parts.hpp"
#include "saltus/base/list.hpp"

namespace saltus::detail {

namespace {

using Named = std::optional<std::vector<int>>;

void mark(std::vector<Reading>& inputs, const Named& named, bool Reading::*how) {
  if (!named) {
    for (Reading& input : inputs) input.*how = true;
    return;
  }
  for (int i : *named) nth(inputs, i).*how = true;
}

/// Marks the inputs that the derivative reads, and those of outputs that some node reads.
void mark_flow(const Plan& plan, const PlanLeaf& leaf, std::vector<Reading>& inputs) {
  const Declarations& d = leaf.declared();
  if (leaf.nx > 0 && d.continuous.ode && has(d.continuous.reads, Reads::inputs))
    mark(inputs, d.continuous.inputs, &Reading::flow);
  for (std::size_t i = 0; i < d.outputs.size(); ++i) {
    const Node& node = plan.node(leaf.outputs[i]);
    if (node.used && !node.view && has(d.outputs[i].reads, Reads::inputs))
      mark(inputs, d.outputs[i].inputs, &Reading::flow);
  }
  for (std::size_t i = 0; i < d.relations.size(); ++i) {
    if (plan.node(leaf.relations[i]).used && has(d.relations[i].reads, Reads::inputs))
      mark(inputs, d.relations[i].inputs, &Reading::flow);
  }
}

void mark_events(const Declarations& d, std::vector<Reading>& inputs) {
  for (const ZeroCrossing& crossing : d.zero_crossings) {
    if (crossing.direction == Direction::none) continue;
    mark(inputs, crossing.reset_map ? Named() : crossing.inputs, &Reading::event);
  }
  for (const EdgeReset& reset : d.edge_resets) {
    mark(inputs, std::vector{reset.input}, &Reading::event);
    mark(inputs, reset.inputs, &Reading::event);
  }
  for (const TimeEvent& event : d.time_events) {
    if (event.update) mark(inputs, event.inputs, &Reading::event);
  }
  for (const EventInputDeclaration& input : d.event_inputs)
    mark(inputs, input.inputs, &Reading::event);
  for (const History& history : d.histories)
    mark(inputs, std::vector{history.input}, &Reading::event);
}

bool has_events(const Declarations& d) {
  return !d.zero_crossings.empty() || !d.edge_resets.empty() || !d.time_events.empty() ||
         !d.event_inputs.empty();
}

}  // namespace

Readings readings_of(const Plan& plan) {
  Readings all;
  for (const PlanLeaf& leaf : plan.leaves) {
    std::vector<Reading> inputs(leaf.inputs.size());
    mark_flow(plan, leaf, inputs);
    mark_events(leaf.declared(), inputs);
    all.push_back(std::move(inputs));
  }
  return all;
}

Picture::Flow flow_of(const Node& node) {
  if (!node.used) return Picture::Flow::dropped;
  return node.rate == Rate::constant ? Picture::Flow::folded
         : node.rate == Rate::held   ? Picture::Flow::held
                                     : Picture::Flow::continuous;
}

Picture::Flow flow_of(const Plan& plan, const PlanLeaf& leaf) {
  using Flow = Picture::Flow;
  if (leaf.nx > 0) return Flow::continuous;
  Flow flow = has_events(leaf.declared()) && leaf.nz > 0 ? Flow::held : Flow::dropped;
  for (int output : leaf.outputs) flow = std::min(flow, flow_of(plan.node(output)));
  return flow;
}

}  // namespace saltus::detail
