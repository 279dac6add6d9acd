// The passes of compile(), in order.
#include "saltus/plan/compile.hpp"

#include "saltus/plan/fuse.hpp"
#include "saltus/plan/needs.hpp"
#include "saltus/plan/order.hpp"

namespace saltus {

namespace {

using namespace detail;

void add_taps(Plan& plan, const RecordedSignals& signals) {
  for (const auto& [name, port] : signals) {
    if (port.system == nullptr)
      throw ModelError(text("recorded signal '", name, "' names no output port"));
    const LeafPort source = port.system->output_source(port.index);
    const auto leaf = std::ranges::find(plan.leaves, source.leaf, &PlanLeaf::system);
    if (leaf == plan.leaves.end()) {
      throw ModelError(text("recorded signal '", name, "' belongs to block '", port.system->name(),
                            "', which is not part of this system"));
    }
    const bool twice =
        std::ranges::any_of(plan.taps, [&](const Tap& tap) { return tap.name == name; });
    if (twice) throw ModelError(text("two recorded signals are called '", name, "'"));
    plan.taps.push_back({name, leaf->outputs[static_cast<std::size_t>(source.index)]});
  }
}

/// The blocks whose continuous state shows in `nodes`, as it is or through feedthrough.
std::vector<int> leaves_behind(const Plan& plan, const std::vector<int>& nodes) {
  Marks reached(plan.nodes.size());
  spread(plan, nodes, reached, [](const Node& node) { return node.rate != Rate::continuous; });
  std::vector<int> leaves;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const int leaf = plan.nodes[i].leaf;
    if (reached[i] && plan.nodes[i].rate == Rate::continuous &&
        plan.leaves[static_cast<std::size_t>(leaf)].nx > 0) {
      leaves.push_back(leaf);
    }
  }
  return leaves;
}

/// The blocks whose continuous state moves a guard, at once or through the derivative of one that
/// does.
std::vector<int> moving_leaves(const Plan& plan, int own, const std::vector<int>& nodes) {
  std::vector<int> leaves = leaves_behind(plan, nodes);
  if (plan.leaves[static_cast<std::size_t>(own)].nx > 0) leaves.push_back(own);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const PlanLeaf& leaf = plan.leaves[static_cast<std::size_t>(leaves[i])];
    for (int more : leaves_behind(plan, read_inputs(leaf.declared().continuous.inputs, leaf))) {
      if (std::ranges::find(leaves, more) == leaves.end()) leaves.push_back(more);
    }
  }
  return leaves;
}

void add_guard(Plan& plan, GuardGroup group, const std::vector<int>& reads) {
  group.leaves = moving_leaves(plan, group.leaf, reads);
  group.slot = plan.guard_slots;
  plan.guard_slots += group.size;
  plan.guards.push_back(std::move(group));
}

/// Zero crossings first, in declaration order, then relations and opaque booleans.
void add_guards(Plan& plan) {
  for (std::size_t l = 0; l < plan.leaves.size(); ++l) {
    const auto& crossings = plan.leaves[l].declared().zero_crossings;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const ZeroCrossing& crossing = crossings[i];
      if (crossing.direction == Direction::none) continue;  // never fires: never computed
      const bool monitor = !crossing.reset_map && !crossing.end_mode && !crossing.terminal;
      add_guard(plan,
                {.kind = GuardGroup::Kind::crossing,
                 .leaf = static_cast<int>(l),
                 .index = static_cast<int>(i),
                 .size = crossing.size,
                 .direction = crossing.direction,
                 .monitor = monitor,
                 .name = text(plan.leaves[l].path, ".", crossing.name)},
                read_inputs(crossing.inputs, plan.leaves[l]));
    }
  }
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const Node& node = plan.nodes[i];
    if (!node.located) continue;
    add_guard(plan,
              {.kind = node.relation ? GuardGroup::Kind::relation : GuardGroup::Kind::opaque,
               .leaf = node.leaf,
               .index = static_cast<int>(i),
               .size = node.shape.size,
               .name = node.name},
              node.needs);
  }
}

void add_edges(Plan& plan) {
  for (std::size_t l = 0; l < plan.leaves.size(); ++l) {
    const PlanLeaf& leaf = plan.leaves[l];
    const auto& resets = leaf.declared().edge_resets;
    for (std::size_t i = 0; i < resets.size(); ++i) {
      EdgeWatch edge{.leaf = static_cast<int>(l),
                     .index = static_cast<int>(i),
                     .node = read_inputs(std::vector{resets[i].input}, leaf).front(),
                     .name = text(leaf.path, ".", resets[i].name)};
      const Node& trigger = plan.node(edge.node);
      if (trigger.rate == Rate::continuous || trigger.shape.size != 1) {
        throw ModelError(
            text("input '", leaf.declared().inputs[static_cast<std::size_t>(resets[i].input)].name,
                 "' of block '", leaf.path, "' expects one boolean, found ", trigger.shape.size,
                 " continuous value(s) from output '", trigger.name,
                 "'; put a Comparator between them"));
      }
      Marks reached(plan.nodes.size());
      spread(plan, {edge.node}, reached, [](const Node&) { return false; });
      for (std::size_t k = 0; k < reached.size(); ++k) {
        if (reached[k] && plan.nodes[k].located) edge.relations.push_back(static_cast<int>(k));
      }
      plan.edges.push_back(std::move(edge));
    }
  }
}

void add_schedule(Plan& plan) {
  for (std::size_t l = 0; l < plan.leaves.size(); ++l) {
    const auto& events = plan.leaves[l].declared().time_events;
    for (std::size_t i = 0; i < events.size(); ++i) {
      plan.schedule.push_back({static_cast<int>(l), static_cast<int>(i), events[i].period,
                               events[i].offset, text(plan.leaves[l].path, ".", events[i].name)});
    }
    if (plan.leaves[l].nx > 0) plan.odes.push_back(static_cast<int>(l));
  }
}

}  // namespace

std::shared_ptr<const Plan> compile(const System& system, const RecordedSignals& recorded) {
  Plan plan = flatten(system);
  add_taps(plan, recorded);
  find_located(plan);
  release_held_relations(plan);
  add_order(plan);
  lay_out(plan);
  find_rates(plan);
  find_slices(plan);
  add_guards(plan);
  add_edges(plan);
  add_schedule(plan);
  fuse(plan);
  return std::make_shared<const Plan>(std::move(plan));
}

}  // namespace saltus
