// Relations: truths held between instants, flipped and read again.
#include "saltus/simulation/detail/relations.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

Relations::Relations(const Scope& scope, Machine& machine, GuardSet& guards,
                     const SimulatorOptions& options, Flow& flow, Edges& edges, Holds& holds,
                     ContactGuards& contacts, const Transition& transition, Journal& journal,
                     Present& present)
    : scope_(&scope),
      machine_(&machine),
      guards_(&guards),
      options_(&options),
      flow_(&flow),
      edges_(&edges),
      holds_(&holds),
      contacts_(&contacts),
      transition_(&transition),
      journal_(&journal),
      present_(&present) {}

double& Relations::truth(std::size_t k) const {
  const Guard& guard = (*guards_)[k];
  return machine_->truth_at(machine_->plan().guard(guard.group).index, guard.entry);
}

bool Relations::true_at_zero(const GuardGroup& group) const {
  const Node& node = machine_->plan().node(group.index);
  return node.relation && machine_->plan().relation_of(node).true_at_zero;
}

/// One round for each relation is enough, unless the relations have no consistent truths.
void Relations::begin(double t) {
  const Plan& plan = machine_->plan();
  for (std::size_t round = 0; round <= plan.guards.size(); ++round) {
    bool changed = false;
    machine_->evaluate_instant(t);
    if (!plan.guards.empty()) machine_->guards(t, machine_->x.data(), present_->g.data());
    for (const std::size_t k : scope_->relations) {
      const bool at_zero = true_at_zero(plan.guard((*guards_)[k].group));
      const double g = present_->g[k];
      const bool now = g > 0.0 || (g == 0.0 && at_zero);
      changed = changed || (truth(k) != 0.0) != now;
      truth(k) = now ? 1.0 : 0.0;
      guards_->turn(k, now ? 1 : -1);
    }
    if (!changed) break;
  }
}

bool Relations::turns_back(const Firing& firing) {
  const std::size_t k = firing.guard();
  const GuardGroup& group = machine_->plan().guard((*guards_)[k].group);
  if (group.is_crossing() || group.is_opaque()) return false;
  Departure::Side flow;
  const auto flow_to = [&] {
    flow = flow_->side(group, static_cast<Index>(k), 0.0, Departure::either_side);
    return flow.side;
  };
  if (!only_touches(guards_->g[k], firing.from, flow_to)) return false;
  guards_->wait(k, firing.from, flow.rounding);
  return true;
}

void Relations::flip(const Firing& firing) {
  const std::size_t k = firing.guard();
  const Guard& guard = (*guards_)[k];
  if (++present_->note(k).flips == thresholds::fluttering_flips) present_->outcome.flutters = true;
  truth(k) = firing.from < 0 ? 1.0 : 0.0;
  guards_->turn(k, firing.from < 0 ? 1 : -1);
  journal_->note({.kind = EventKind::zero_crossing,
                  .source = guard.group,
                  .leaf = machine_->plan().guard(guard.group).leaf,
                  .direction = -firing.from});
}

void Relations::read_again() {
  machine_->evaluate_instant(present_->t);
  if (machine_->plan().guards.empty()) return;
  for (int round = 0; round < options_->max_passes; ++round) {
    bool flipped = false;
    machine_->guards_at(present_->t, machine_->x.data(), present_->g.data());
    for (const std::size_t k : guards_->active().relations())
      flipped = read(machine_->plan().guard((*guards_)[k].group), k) || flipped;
    if (!flipped) return;
    machine_->evaluate_instant(present_->t);
  }
}

/// Reads the present truth of a relation. True if the truth changed. At its own zero the relation
/// keeps its truth until `arm` asks the flow. After it fired and a reset wrote, the flow decides
/// its side.
bool Relations::read(const GuardGroup& group, std::size_t k) {
  const GuardNow& now = present_->now(k);
  if (now.frozen || ((*guards_)[k].rests && !reads_changed(group.index))) return false;
  if (contacts_->still_at_rest(k)) return false;
  const bool was = truth(k) != 0.0;
  const RelationFacts facts{.opaque = group.is_opaque(),
                            .truth = was,
                            .g = present_->g[k],
                            .fired = now.fired,
                            .came_from = (*guards_)[k].came_from,
                            .turned = now.turned,
                            .wrote = transition_->writes().of(group) > 0};
  const std::optional<int> by_value = decide_relation(facts);
  const int side = by_value ? side_at_zero(group, k, facts, *by_value)
                            : side_by_flow(group, k, facts.crossed_to());
  if (side == 0) return false;
  guards_->turn(k, side);
  if ((side > 0) == was) return false;
  guards_->keep_truth(k, false);
  present_->note(k).turned = true;
  contacts_->leave(k);
  truth(k) = side > 0 ? 1.0 : 0.0;
  if (!machine_->plan().needs.restarting.empty()) flow_->forget();
  return true;
}

/// The side by the value of a relation, which may be exactly at zero.
int Relations::side_at_zero(const GuardGroup& group, std::size_t k, const RelationFacts& facts,
                            int side) {
  return decide_at_zero(facts, side, true_at_zero(group), [&] {
    return flow_->side(group, static_cast<Index>(k), 0.0, Departure::either_side).side == 0;
  });
}

/// The side to which the flow takes a relation; the side of its crossing if the flow leads to no
/// side. If the flow leads back to the side that set off a reset, and the reset left the relation at
/// its zero, the blocks of that reset come to rest.
int Relations::side_by_flow(const GuardGroup& group, std::size_t k, int crossed_to) {
  const auto slot = static_cast<Index>(k);
  const bool opaque = group.is_opaque();
  const GuardNow& now = present_->now(k);
  const Departure::Side flow =
      flow_->side(group, slot, opaque ? 0.0 : now.location, opaque ? 0 : Departure::either_side);
  const auto leads_back = [&] {
    return opaque || flow_->leads_back(group, slot, -crossed_to, transition_->before());
  };
  const bool at_zero = opaque || now.jumped() || std::abs(present_->g[k]) <= flow.rounding;
  const bool set_off = flow.side == crossed_to && edges_->set_off_by(group.index);
  const RelationSide then =
      decide_relation_side(flow.side, crossed_to, set_off, at_zero, leads_back);
  if (!then.rests) return then.side;
  present_->note(k).frozen = true;
  if (holds_->hold_edges(edges_->fired(), group.index)) {
    guards_->keep_truth(k, true);
    return flow.side;
  }
  present_->outcome.stuck = true;  // without a monitor it fires again at once
  return -crossed_to;
}

/// Whether a signal that a relation reads was written in this instant. The value of the relation
/// itself is rounding at rest.
bool Relations::reads_changed(int node) const {
  const Plan& plan = machine_->plan();
  return std::ranges::any_of(plan.node(node).needs, [&](int need) {
    const Node& read = plan.node(need);
    if (read.rate != Rate::continuous || read.view) return transition_->changed(read.place);
    return transition_->writes().of(read.leaf) > 0 || reads_changed(need);
  });
}

/// Arms a relation. Near its zero it may only leave the zero, not cross it, until it has been
/// clearly off.
void Relations::arm(std::size_t k) {
  const Guard& guard = (*guards_)[k];
  if (guard.rests) return contacts_->arm_relation(k);
  const GuardGroup& group = machine_->plan().guard(guard.group);
  const GuardNow& now = present_->now(k);
  const int side = guard.side;
  switch (decide_relation_arming(group.is_opaque(), sign_of(present_->g[k]), side, now.fired,
                                 now.frozen)) {
    case RelationArming::by_truth:
      return guards_->turn(k, truth(k) != 0.0 ? 1 : -1);
    case RelationArming::unchanged:
      return;
    case RelationArming::within_value:
      return guards_->wait(k, side, std::abs(present_->g[k]));
    case RelationArming::by_flow:
      break;
  }
  const Departure::Side flow =
      flow_->side(group, static_cast<Index>(k), now.fired ? present_->error_so_far(k) : 0.0, side);
  guards_->wait(k, side, flow.rounding);
  if (flow.side != 0 && flow.side != side) present_->fire(k, side);
}

std::vector<double> Relations::save() const {
  std::vector<double> truths;
  for (const std::size_t k : scope_->relations) truths.push_back(truth(k));
  return truths;
}

bool Relations::fits(const Continuation& from) const {
  return scope_->relations.size() == from.relations.size();
}

void Relations::load(const Continuation& from) {
  auto saved = from.relations.begin();
  for (const std::size_t k : scope_->relations) truth(k) = *saved++;
}

}  // namespace saltus
