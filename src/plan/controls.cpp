// Controls: the leaves of controlled parts get their control signals.
#include "saltus/plan/detail/controls.hpp"

#include "controlled_leaf.hpp"

namespace saltus::detail {

void add_controls(Plan& plan, const Structure& structure, const LeafNumbers& numbers) {
  for (const Structure::Controlled& part : structure.controlled) {
    const int source =
        plan.leaf(numbers.find(part.control.leaf).value()).outputs[part.control.index];
    for (std::size_t i = part.first; i < part.last; ++i) {
      PlanLeaf& leaf = plan.leaves[i];
      ControlledLeaf controlled(leaf);
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
