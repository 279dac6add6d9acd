// The passes of compile(), in order.
#include "saltus/plan/compile.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <unordered_set>

#include "saltus/plan/detail/flow_divisors.hpp"
#include "saltus/plan/detail/flow_series.hpp"
#include "saltus/plan/detail/fuse.hpp"
#include "saltus/plan/detail/guard_waves.hpp"
#include "saltus/plan/detail/kept.hpp"
#include "saltus/plan/detail/needs.hpp"
#include "saltus/plan/detail/order.hpp"
#include "saltus/plan/detail/passes.hpp"

namespace saltus {

namespace {

using namespace detail;

void add_taps(Plan& plan, const RecordedSignals& signals) {
  if (signals.empty()) return;
  const LeafNumbers numbers(plan);
  std::unordered_set<std::string_view> names;
  for (const auto& [name, port] : signals) {
    if (port.system == nullptr)
      throw ModelError(text("recorded signal '", name, "' names no output port"));
    const LeafPort source = port.system->output_source(port.system->output(port.index).index);
    const auto leaf = numbers.find(source.leaf);
    if (!leaf) {
      throw ModelError(text("recorded signal '", name, "' belongs to block '", port.system->name(),
                            "', which is not part of this system"));
    }
    if (!names.insert(name).second)
      throw ModelError(text("two recorded signals are called '", name, "'"));
    plan.taps.push_back({name, plan.leaves[*leaf].outputs[source.index]});
  }
}

/// Searches from nodes through the nodes they need. All searches share one memory, so the cost of a
/// search is proportional to what it finds.
class StateSearch {
 public:
  explicit StateSearch(const Plan& plan)
      : plan_(plan), seen_(plan.nodes.size(), 0), met_(plan.leaves.size(), 0) {}

  /// The located nodes that a node depends on.
  std::vector<int> located(int node) {
    begin({node});
    std::vector<int> found;
    while (!open_.empty()) {
      const int i = next();
      if (plan_.node(i).located) found.push_back(i);
      push(plan_.node(i).needs);
    }
    std::ranges::sort(found);
    return found;
  }

  /// The blocks whose continuous state changes a guard of block `own` that reads `nodes`: directly,
  /// through feedthrough, or through the derivative of such a block.
  std::vector<int> moving(int own, const std::vector<int>& nodes) {
    begin(nodes);
    leaves_.clear();
    meet(own);
    while (!open_.empty()) {
      const Node& node = plan_.node(next());
      if (node.rate != Rate::continuous) continue;
      push(node.needs);
      meet(node.leaf);
    }
    return leaves_;
  }

 private:
  void begin(const std::vector<int>& nodes) {
    ++search_;
    push(nodes);
  }
  int next() {
    const int i = open_.back();
    open_.pop_back();
    return i;
  }
  void push(const std::vector<int>& nodes) {
    for (const int i : nodes) {
      if (std::exchange(seen_[i], search_) != search_) open_.push_back(i);
    }
  }
  /// A leaf with a continuous state changes the guard, and the values its derivative reads change
  /// the leaf.
  void meet(int number) {
    const PlanLeaf& leaf = plan_.leaves[number];
    if (leaf.nx == 0 || std::exchange(met_[number], search_) == search_) return;
    leaves_.push_back(number);
    push(read_inputs(leaf.declared().continuous.inputs, leaf));
  }

  const Plan& plan_;
  int search_ = 0;
  List<int> seen_, met_;  // nodes and leaves: the number of the search that saw them
  std::vector<int> open_, leaves_;
};

void add_guard(Plan& plan, StateSearch& search, GuardGroup group, const std::vector<int>& reads) {
  group.leaves = search.moving(group.leaf, reads);
  for (const int control : group.controls) {
    if (std::ranges::find(plan.controls, control) == plan.controls.end())
      plan.controls.push_back(control);
  }
  group.slot = plan.guard_slots;
  plan.guard_slots += group.size;
  plan.guards.push_back(std::move(group));
}

/// A guard whose return cancels its execution is located both ways.
Direction watched_direction(const ZeroCrossing& crossing) {
  return crossing.is_queued() && crossing.is_cancelled_on_return() ? Direction::crosses_zero
                                                                   : crossing.direction;
}

/// The events from which event wires start, by leaf and number.
std::set<std::pair<int, int>> senders_of(const Plan& plan) {
  std::set<std::pair<int, int>> senders;
  for (const EventWire& wire : plan.event_wires.declared) senders.insert({wire.from, wire.event});
  for (const auto& sender : plan.event_wires.senders) senders.insert({sender.leaf, sender.event});
  return senders;
}

/// Adds zero crossings first, in declaration order, then relations and opaque booleans.
void add_guards(Plan& plan) {
  StateSearch search(plan);
  const auto senders = senders_of(plan);
  for (std::size_t l = 0; l < plan.leaves.size(); ++l) {
    const auto& crossings = plan.leaves[l].declared().zero_crossings;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const ZeroCrossing& crossing = crossings[i];
      if (crossing.direction == Direction::none) continue;  // never fires: never computed
      const bool sends = senders.contains({static_cast<int>(l), static_cast<int>(i)});
      const bool monitor = !crossing.has_effect() && !crossing.terminal && !sends;
      add_guard(plan, search,
                {.kind = GuardGroup::Kind::crossing,
                 .leaf = static_cast<int>(l),
                 .index = static_cast<int>(i),
                 .size = crossing.size,
                 .direction = watched_direction(crossing),
                 .monitor = monitor,
                 .queued = crossing.is_queued(),
                 .sends = sends,
                 .name = text(plan.leaves[l].path, ".", crossing.name),
                 .controls = read_inputs(plan.leaves[l].declared().controls, plan.leaves[l])},
                read_inputs(crossing.inputs, plan.leaves[l]));
    }
  }
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const Node& node = plan.nodes[i];
    if (!node.located) continue;
    add_guard(plan, search,
              {.kind = node.relation ? GuardGroup::Kind::relation : GuardGroup::Kind::opaque,
               .leaf = node.leaf,
               .index = static_cast<int>(i),
               .size = node.shape.size,
               .name = plan.name_of(node)},
              node.needs);
  }
}

/// A watched signal has to be one held boolean.
void check_edges(const Plan& plan) {
  for (const PlanLeaf& leaf : plan.leaves) {
    for (const EdgeReset& reset : leaf.declared().edge_resets) {
      require_one_held_value(plan, read_inputs(std::vector{reset.input}, leaf).front(),
                             text("input '", leaf.declared().inputs[reset.input].name,
                                  "' of block '", leaf.path, "' expects one boolean"));
    }
  }
}

void add_edges(Plan& plan) {
  StateSearch search(plan);
  for (std::size_t l = 0; l < plan.leaves.size(); ++l) {
    const PlanLeaf& leaf = plan.leaves[l];
    const auto& resets = leaf.declared().edge_resets;
    for (std::size_t i = 0; i < resets.size(); ++i) {
      EdgeWatch edge{.leaf = static_cast<int>(l),
                     .index = static_cast<int>(i),
                     .node = read_inputs(std::vector{resets[i].input}, leaf).front(),
                     .reads = read_inputs(resets[i].inputs, leaf),
                     .name = text(leaf.path, ".", resets[i].name)};
      edge.relations = search.located(edge.node);
      plan.reads_before = plan.reads_before || resets[i].reads_before;
      plan.edges.push_back(std::move(edge));
    }
  }
}

void add_schedule(Plan& plan) {
  for (std::size_t l = 0; l < plan.leaves.size(); ++l) {
    const auto& events = plan.leaves[l].declared().time_events;
    for (std::size_t i = 0; i < events.size(); ++i) {
      plan.schedule.push_back({.leaf = static_cast<int>(l),
                               .index = static_cast<int>(i),
                               .period = events[i].period,
                               .offset = events[i].offset,
                               .name = text(plan.leaves[l].path, ".", events[i].name),
                               .ticks = events[i].ticks(),
                               .times = events[i].times.value_or(std::vector<double>{}),
                               .by_state = static_cast<bool>(events[i].next)});
    }
    if (plan.leaves[l].nx > 0) plan.odes.push_back(static_cast<int>(l));
    if (!plan.leaves[l].declared().histories.empty()) plan.histories.push_back(static_cast<int>(l));
    if (!plan.leaves[l].declared().parameter_checks.empty())
      plan.checked.push_back(static_cast<int>(l));
    if (!plan.leaves[l].declared().start_checks.empty())
      plan.starting.push_back(static_cast<int>(l));
  }
}

/// The passes that may refuse a system. They find the shape and the rate of every signal.
struct Sound {
  Sound(const System& system, const RecordedSignals& recorded, const Replacements& replacements)
      : plan(flatten(system, replacements)) {
    add_taps(plan, recorded);
    roots = find_shapes_and_rates(plan);
  }

  Plan plan;
  Roots roots;
};

Replacements before(const System& system, Refinement& refinement) {
  Replacements replacements;
  for (const Structure::Leaf& leaf : structure_of(system).leaves)
    replacements.push_back(refinement.before(*leaf.system));
  return replacements;
}

/// Returns whether any leaf got other declarations.
bool refine(const Plan& plan, Refinement& refinement, Replacements& replacements) {
  bool any = false;
  for (std::size_t i = 0; i < replacements.size(); ++i) {
    if (replacements[i]) continue;
    replacements[i] = refinement.with_shapes(plan, plan.leaves[i]);
    any = any || replacements[i];
  }
  return any;
}

/// The declarations of a system, not its refinement, decide whether the system is sound: an
/// algebraic loop through an input that a traced function does not read remains an error.
Sound refined(const System& system, const RecordedSignals& recorded, Refinement& refinement) {
  Replacements replacements = before(system, refinement);
  Sound sound(system, recorded, replacements);
  if (refine(sound.plan, refinement, replacements)) return {system, recorded, replacements};
  return sound;
}

}  // namespace

Roots detail::find_shapes_and_rates(Plan& plan) {
  Roots roots = find_roots(plan);
  find_located(plan, roots);
  release_held_relations(plan);
  add_order(plan);
  lay_out(plan);
  find_rates(plan);
  check_edges(plan);
  check_controls(plan);
  return roots;
}

std::shared_ptr<const Plan> detail::completed(Plan plan, const Roots& roots) {
  find_slices(plan, roots);
  add_guards(plan);
  add_edges(plan);
  add_schedule(plan);
  if (plan.event_wires.any()) sort_event_wires(plan);
  add_reads_of_guards(plan);
  find_guards_that_turn(plan);
  fuse(plan);
  plan.series = std::make_shared<Kept<FlowSeries>>();
  plan.divisors = std::make_shared<Kept<FlowDivisors>>();
  plan.waves = std::make_shared<Kept<GuardWaves>>();
  return std::make_shared<const Plan>(std::move(plan));
}

std::shared_ptr<const Plan> compile(const System& system, const RecordedSignals& recorded,
                                    Refinement* refinement) {
  auto [plan, roots] =
      refinement ? refined(system, recorded, *refinement) : Sound(system, recorded, {});
  return completed(std::move(plan), roots);
}

}  // namespace saltus
