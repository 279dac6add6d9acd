// Plan::describe(): says what was kept, folded and dropped, and why.
#include <map>
#include <string>
#include <vector>

#include "saltus/model/computed_parameter.hpp"
#include "saltus/model/detail/diagram_parameters.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

namespace {

void describe_list(std::string& out, const Plan& plan, std::string_view title,
                   const std::vector<int>& nodes) {
  out += text("  ", title, ": ", nodes.size());
  for (std::size_t i = 0; i < nodes.size() && i < 8; ++i)
    out += text(i == 0 ? " (" : ", ", plan.name_of(plan.node(nodes[i])));
  if (!nodes.empty()) out += nodes.size() > 8 ? ", ...)" : ")";
  out += "\n";
}

/// `what` names the sinks of the list, one for each entry of `walk.fused`.
void describe_walk(std::string& out, const Plan& plan, const Walk& walk, std::string_view what) {
  if (!walk.fuses()) return;
  auto calls = std::ranges::count_if(
      walk.stages, [](const Walk::Stage& stage) { return static_cast<bool>(stage.fused); });
  calls += walk.last ? 1 : 0;
  describe_list(out, plan, text("  of these fused into ", calls, calls == 1 ? " call" : " calls"),
                walk.nodes);
  const auto fused = std::ranges::count(walk.fused, char{1});
  out += text("    and with them ", fused, " of ", walk.fused.size(), " ", what, "\n");
}

void describe_guard(std::string& out, const Plan& plan, const GuardGroup& guard) {
  using Kind = GuardGroup::Kind;
  out += text("  guard '", guard.name, "': ");
  if (guard.kind == Kind::crossing) {
    out +=
        text(to_string(guard.direction), guard.queued    ? ", a trigger: it schedules an execution"
                                         : guard.monitor ? ", a monitor: located, changes nothing"
                                         : guard.sends   ? ", event wires start from it"
                                                         : "");
  } else if (guard.kind == Kind::relation) {
    out += "a relation, held between instants";
  } else {
    out += text("block '", plan.leaves[guard.leaf].path,
                "' is an opaque boolean: located by bisection; a Comparator would be faster");
  }
  out += "\n";
}

/// The blocks of which the random numbers are the same, or follow from the same ones.
void describe_seeds(std::string& out, const Plan& plan) {
  std::map<double, std::vector<std::string>> blocks;
  for (const PlanLeaf& leaf : plan.leaves) {
    const auto& declared = leaf.declared();
    if (declared.seed)
      blocks[declared.parameter_values[declared.seed->offset]].push_back(leaf.path);
  }
  for (const auto& [seed, paths] : blocks) {
    if (paths.size() < 2) continue;
    out += text("  the random numbers of ", paths.size(),
                " blocks are not independent, because all have the seed ", seed, ": ",
                quoted_list(paths), "\n");
  }
}

void describe_controls(std::string& out, const Plan& plan) {
  for (const PlanLeaf& leaf : plan.leaves) {
    for (const int control : leaf.declared().controls)
      out += text("  block '", leaf.path, "' is executed while '",
                  plan.name_of(plan.node(leaf.inputs[control])), "' is true\n");
  }
}

void describe_guards(std::string& out, const Plan& plan) {
  out += plan.guards.empty() ? "no guards: no root-finding\n"
                             : text("guards: ", plan.guard_slots, "\n");
  for (const GuardGroup& guard : plan.guards) describe_guard(out, plan, guard);
}

/// What happens at instants beside the guards.
void describe_events(std::string& out, const Plan& plan) {
  if (!plan.edges.empty()) out += text("resets that follow an edge: ", plan.edges.size(), "\n");
  if (!plan.schedule.empty()) out += text("time events: ", plan.schedule.size(), "\n");
  if (plan.event_wires.any())
    out += text("event wires: ", plan.event_wires.declared.size(), ", in ",
                plan.event_wires.batches.size(), " batches of one event and one delay\n");
}

/// The nodes of which `is` holds.
template <class Is>
std::vector<int> nodes_that(const Plan& plan, const Is& is) {
  std::vector<int> found;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i)
    if (is(plan.nodes[i])) found.push_back(static_cast<int>(i));
  return found;
}

/// The parameters of a diagram are no block.
bool is_block(const PlanLeaf& leaf) {
  return dynamic_cast<const DiagramParameters*>(leaf.system) == nullptr;
}

}  // namespace

std::string Plan::describe() const {
  const auto blocks = std::ranges::count_if(leaves, is_block);
  std::string out = text("plan: ", blocks, blocks == 1 ? " block, " : " blocks, ", nx,
                         " continuous and ", nz, " discrete states\n");
  if (computed) out += text("parameters that diagrams compute: ", computed->all.size(), "\n");
  const auto views = nodes_that(*this, [](const Node& n) { return n.view; });
  const auto dropped =
      nodes_that(*this, [](const Node& n) { return !n.view && !n.used && !n.relation; });
  out += text("outputs: ", std::ranges::count_if(nodes, [](const Node& n) { return !n.relation; }),
              "\n");
  describe_list(out, *this, "views of a state or parameter, never copied", views);
  describe_list(out, *this, "constant, computed once", needs.constants);
  describe_list(out, *this, "computed at instants", needs.instants);
  describe_list(out, *this, "computed for the derivatives", needs.derivatives);
  describe_walk(out, *this, walks.derivatives, "derivatives of blocks");
  describe_list(out, *this, "computed for the guards", needs.guards);
  describe_walk(out, *this, walks.guards, "guards");
  describe_list(out, *this, "computed for recorded rows", needs.taps);
  if (!histories.empty()) describe_list(out, *this, "computed for histories", needs.histories);
  describe_list(out, *this, "dropped, nothing reads them", dropped);
  describe_guards(out, *this);
  describe_controls(out, *this);
  describe_seeds(out, *this);
  describe_events(out, *this);
  if (odes.empty()) out += "no continuous state: no solver\n";
  out += taps.empty() ? "nothing recorded: no recorder\n"
                      : text("recorded signals: ", taps.size(), "\n");
  return out;
}

}  // namespace saltus
