// Controls: the leaves of controlled parts get their control signals.
#include "saltus/plan/detail/controls.hpp"

#include "controlled_leaf.hpp"

namespace saltus::detail {

namespace {

int source_of(const Plan& plan, const LeafNumbers& numbers, const LeafPort& control) {
  return plan.leaf(numbers.find(control.leaf).value()).outputs[control.index];
}

/// The control signals of enabled parts that nothing else uses.
std::vector<int> gated_signals(const Plan& plan, const Structure& structure,
                               const LeafNumbers& numbers) {
  std::vector<int> gated;
  for (const Structure::Controlled& part : structure.controlled) {
    const int source = source_of(plan, numbers, part.control);
    if (part.execution.kind == Execution::Kind::enabled &&
        plan.output_of(plan.node(source)).controls_only)
      gated.push_back(source);
  }
  return gated;
}

}  // namespace

void add_controls(Plan& plan, const Structure& structure, const LeafNumbers& numbers) {
  const std::vector<int> gated = gated_signals(plan, structure, numbers);
  for (const Structure::Controlled& part : structure.controlled) {
    const int source = source_of(plan, numbers, part.control);
    for (std::size_t i = part.first; i < part.last; ++i) {
      PlanLeaf& leaf = plan.leaves[i];
      ControlledLeaf controlled(leaf, gated);
      const bool enabled = part.execution.kind == Execution::Kind::enabled;
      leaf.declarations =
          std::make_shared<const Declarations>(enabled ? controlled.enabled(part.execution.resets)
                                                       : controlled.triggered(part.execution.edge));
      leaf.inputs.push_back(source);
    }
  }
}

void require_one_held_value(const Plan& plan, int node, const std::string& expected) {
  const Node& signal = plan.node(node);
  if (signal.rate != Rate::continuous && signal.shape.size == 1) return;
  throw ModelError(text(expected, ", found ", signal.shape.size,
                        " continuous value(s) from output '", plan.name_of(signal),
                        "'; put a Comparator between them"));
}

void check_controls(const Plan& plan) {
  for (const PlanLeaf& leaf : plan.leaves) {
    for (const int control : leaf.declared().controls)
      require_one_held_value(
          plan, leaf.inputs[control],
          text("block '", leaf.path, "' expects one held value as its control signal"));
    for (const TimeEvent& event : leaf.declared().time_events) {
      if (!event.inherited) continue;
      throw ModelError(
          text("block '", leaf.path, "': event '", event.name,
               "' has an inherited sample time, and no TriggeredSubsystem contains the "
               "block; give it a period > 0 s, or put it into a TriggeredSubsystem"));
    }
  }
}

}  // namespace saltus::detail
