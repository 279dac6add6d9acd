// Holds: what each of them can stop, from the plan.
#include <unordered_map>
#include <utility>

#include "saltus/base/list.hpp"
#include "saltus/simulation/detail/holds.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

Holds::Holds(Machine& machine, const GuardSet& guards, const SimulatorOptions& options, Flow& flow,
             Transition& transition, Journal& journal, Present& present)
    : machine_(&machine),
      options_(&options),
      flow_(&flow),
      transition_(&transition),
      journal_(&journal),
      present_(&present),
      parts_(machine.plan()) {
  add_guards(guards);
  add_edges();
  changed_.reserve(of_guards_.size() + of_edges_.size());
}

/// The default tolerance says nothing of a scene whose times are shorter still, so a gap also has to
/// be short beside the longest one.
ZenoMonitor Holds::new_monitor(std::optional<double> own) const {
  const double tolerance = own.value_or(options_->zeno_tolerance);
  const double share = tolerance == default_zeno_tolerance ? thresholds::short_gap : 1.0;
  return ZenoMonitor(tolerance, options_->rtol, share);
}

void Holds::add_guards(const GuardSet& guards) {
  const Plan& plan = machine_->plan();
  for (const Guard& guard : guards.all()) {
    Hold& hold = of_guards_.emplace_back();
    const GuardGroup& group = plan.guard(guard.group);
    if (!group.is_crossing() || group.queued || !plan.crossing_of(group).has_effect()) continue;
    const ZeroCrossing& crossing = plan.crossing_of(group);
    const PlanLeaf& leaf = plan.leaf(group.leaf);
    hold = {.monitor = new_monitor(crossing.zeno_tolerance),
            .leaf = group.leaf,
            .source = guard.group,
            .entry = guard.entry,
            .on_zeno = crossing.on_zeno,
            .groups = {guard.group},
            .of_plan = parts_.whole(leaf)};
    if (!crossing.holds.empty())
      hold.of_plan = parts_.choose(leaf, nth(crossing.holds, guard.entry));
    else if (crossing.touches && !steers(crossing, group.leaf))
      hold.of_plan = parts_.choose(leaf, crossing.touches->of_guard(guard.entry));
  }
}

/// Whether an effect writes a discrete state or a mode that derivatives read: it acts on the flow
/// of all states of its leaf (4.4).
bool Holds::steers(const ZeroCrossing& crossing, int leaf) const {
  const bool mode = crossing.end_mode || crossing.touches->writes_mode;
  return (mode && derivatives_read(machine_->plan(), Reads::mode, leaf)) ||
         (crossing.touches->writes_discrete_state &&
          derivatives_read(machine_->plan(), Reads::discrete_state, leaf));
}

void Holds::add_edges() {
  const Plan& plan = machine_->plan();
  std::unordered_map<int, int> group_of;  // of each located node
  for (std::size_t i = 0; i < plan.guards.size(); ++i)
    if (!plan.guards[i].is_crossing()) group_of.emplace(plan.guards[i].index, static_cast<int>(i));
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const EdgeReset& reset = plan.reset_of(plan.edges[e]);
    std::vector<int> groups;
    for (const int node : plan.edges[e].relations) groups.push_back(group_of.at(node));
    of_edges_.push_back({.monitor = new_monitor(reset.zeno_tolerance),
                         .leaf = plan.edges[e].leaf,
                         .source = journal_->source_of(Cause::edge, static_cast<int>(e)),
                         .on_zeno = reset.on_zeno,
                         .groups = std::move(groups),
                         .of_plan = parts_.whole(plan.leaf(plan.edges[e].leaf))});
  }
}

}  // namespace saltus
