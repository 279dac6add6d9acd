// Arming of zero crossings: facts collected, decisions carried out.
#include "saltus/simulation/detail/crossing_arming.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saltus {

CrossingArming::CrossingArming(Machine& machine, GuardSet& guards, Flow& flow, Holds& holds,
                               ContactGuards& contacts, Transition& transition, Present& present)
    : machine_(&machine),
      guards_(&guards),
      flow_(&flow),
      holds_(&holds),
      contacts_(&contacts),
      transition_(&transition),
      present_(&present) {}

const GuardGroup& CrossingArming::group_of(std::size_t k) const {
  return machine_->plan().guard((*guards_)[k].group);
}

CrossingFacts CrossingArming::facts_of(std::size_t k, bool at_start) const {
  const Guard& guard = (*guards_)[k];
  const GuardGroup& group = group_of(k);
  const ZeroCrossing& crossing = machine_->plan().crossing_of(group);
  const GuardNow& now = present_->now(k);
  // A trigger that is located both ways begins as its declared direction says.
  const bool begins = (at_start || now.entered) && !now.fired && !now.put_at_zero;
  return {.direction = begins ? crossing.direction : guard.direction,
          .phase = guard.phase,
          .side = guard.side,
          .g = present_->g[k],
          .error = guard.error,
          .at_start = at_start,
          .entered = now.entered,
          .put_at_zero = now.put_at_zero,
          .fired = now.fired,
          .came_from = guard.came_from,
          .effect = crossing.has_effect(),
          .reset = static_cast<bool>(crossing.reset_map),
          .resets = transition_->writes().of(group),
          .jumped = now.jumped()};
}

/// The facts about guard k that the decisions ask the flow for.
struct CrossingArming::Ask {
  CrossingArming* arming;
  const GuardGroup* group;
  std::size_t k;
  int from;
  double error;

  Index slot() const { return static_cast<Index>(k); }
  int firing_side() const { return saltus::firing_side((*arming->guards_)[k].direction); }
  Flow& flow() const { return *arming->flow_; }
  const Eigen::VectorXd& before() const { return arming->transition_->before(); }

  double slope() const { return flow().slope(*group, slot()); }
  bool is_slope_sure() const { return flow().is_slope_sure(*group, slot()); }
  /// Whether the flight that ended here was too low to differ from rest: its height is within the
  /// error. The height of a parabola is its slope times a quarter of its time. The slope is bounded
  /// from above: a slope that is lost in its rounding is no reason to rest.
  bool too_low() const {
    const double flight = arming->present_->now(k).flight;
    if (std::isnan(flight) || arming->transition_->writes().of(*group) == 0) return false;
    return flow().speed_from(before(), *group, slot(), flight) * flight <= 4.0 * error;
  }
  bool is_struck() const {
    const double onward = firing_side() * slope();
    return saltus::is_struck(onward, firing_side() * flow().slope_from(before(), *group, slot()));
  }
  bool leads_back() const {
    return arming->transition_->writes().of(*group) > 0 &&
           flow().leads_back(*group, slot(), from, before());
  }
  bool moves_together() const {
    return flow().moves_together(*group, slot(), arming->holds_->of_guard(k).states);
  }
  bool stops_at_jump() const {
    return arming->transition_->writes().of(*group) > 0 &&
           flow().stops_at_jump(*group, slot(), from, before());
  }
  /// The execution of a queued guard is not at hand: it may come later, or have come already.
  bool reset_turns(int to) const { return !group->queued && arming->reset_turns(*group, k, to); }
  bool turned_round(int side) const { return arming->turned_round(*group, k, side); }
  bool stood_still() const { return arming->stood_still(*group, k); }
};

void CrossingArming::arm(std::size_t k, bool at_start) {
  const GuardGroup& group = group_of(k);
  const auto slot = static_cast<Index>(k);
  const CrossingFacts facts = facts_of(k, at_start);
  if (facts.direction == Direction::edge_detection) arm_edge(k);
  if (!facts.fired && (at_start || facts.entered) && begins_as_wished(group, k, at_start)) return;
  if (!needs_flow(facts, [&] { return uncertainty(k); })) return;
  const bool counts_as_zero = facts.entered || facts.put_at_zero || facts.phase == Phase::waiting;
  const double error = present_->error_so_far(k, counts_as_zero);
  const Departure::Side flow = flow_->side(group, slot, error, facts.fired ? facts.came_from : 0);
  const Ask ask{this, &group, k, facts.came_from, flow.rounding};
  if (facts.fired) present_->note(k).clear_after = flow.after;
  carry_out(k, decide_crossing(facts, {flow.side, flow.rounding}, ask), flow.rounding);
}

/// A guard of edge_detection that jumped and fired, and whose reset map wrote the state. Its own zero
/// has no meaning, so its values count from the middle between its value before and its present one.
/// Then it is decided as a guard of either direction (2.5): where the flow leads back to its value
/// before, it compares with that value from now on, so that leaving the floor is no second change;
/// where the flow does not lead away, its states rest.
void CrossingArming::arm_edge(std::size_t k) {
  CrossingFacts facts = facts_of(k, false);
  const double before = present_->now(k).before;
  if (!facts.fired || !facts.reset || !facts.wrote() || !facts.jumped || facts.g == before) return;
  const auto slot = static_cast<Index>(k);
  const double middle = 0.5 * before + 0.5 * facts.g;
  facts.direction = Direction::crosses_zero;
  facts.came_from = before > facts.g ? 1 : -1;
  facts.g -= middle;
  const GuardGroup& group = group_of(k);
  flow_->count_from(slot, middle);
  const Departure::Side flow =
      flow_->side(group, slot, present_->error_so_far(k, false), facts.came_from);
  const Ask ask{this, &group, k, facts.came_from, flow.rounding};
  const Arming arming = decide_fired(facts, {flow.side, flow.rounding}, ask);
  flow_->count_from(-1, 0.0);
  if (arming.then == Arming::Then::rest) return carry_out(k, arming, flow.rounding);
  if (arming.side == facts.came_from) guards_->set_base(k, before);
}

double CrossingArming::uncertainty(std::size_t k) {
  const auto slot = static_cast<Index>(k);
  const double slope = flow_->slope(group_of(k), slot);  // first: both keep looks at the flow
  return value_uncertainty(flow_->rounding(slot), slope, present_->t);
}

bool CrossingArming::is_at_zero(std::size_t k) {
  if ((*guards_)[k].direction == Direction::edge_detection) return false;
  const double g = present_->g[k];
  if (g == 0.0) return true;
  return stops_near_zero(guards_->g[k], g) && std::abs(g) <= uncertainty(k);
}

/// Obeys the author's wish for a guard that begins at zero or beyond it. False if the flow has to
/// decide.
bool CrossingArming::begins_as_wished(const GuardGroup& group, std::size_t k, bool at_start) {
  const double g = present_->g[k];
  const ZeroCrossing& crossing = machine_->plan().crossing_of(group);
  switch (decide_beginning(crossing.wish(at_start), crossing.direction, g)) {
    case Beginning::by_flow:
      return false;
    case Beginning::refuse:
      throw SimulationError(
          text("t = ", present_->t, " s: guard '", group.name, "' begins ",
               g == 0.0 ? "at zero" : "beyond zero", " (", g,
               "), and its at_start is \"error\"; begin on its armed side, or choose "
               "\"auto\", \"ignore\" or \"fire\""),
          present_->t, machine_->plan().leaf(group.leaf).path);
    case Beginning::fire:
      present_->fire(k, -firing_side(crossing.direction));
      return true;
    case Beginning::wait: {
      const Departure::Side flow = flow_->side(group, static_cast<Index>(k), 0.0, 0);
      guards_->wait(k, flow.side, flow.rounding);
      return true;
    }
  }
  return false;
}

void CrossingArming::carry_out(std::size_t k, const Arming& arming, double error) {
  if (arming.within == Arming::Within::tolerance)
    error = std::max(error, flow_->tolerance(static_cast<Index>(k), false));
  if (!arming.phase)
    guards_->set_error(k, error);
  else if (*arming.phase == Phase::armed)
    guards_->arm(k, arming.side);
  else
    guards_->wait(k, arming.side, error);
  if (arming.then == Arming::Then::fire) fire_at_zero(k, arming.from);
  if (arming.then != Arming::Then::rest) return;
  Holds::Hold& hold = holds_->of_guard(k);
  guards_->set_error(k, std::abs(present_->g[k]));  // without a monitor it fires again at once
  if (!hold.monitor.on()) {
    present_->outcome.stuck = true;
    return;
  }
  holds_->come_to_rest(hold, present_->t, false);
  if (hold.monitor.holding) contacts_->arm_crossing(k);
}

/// A guard that counts as zero fires away from a root: it is as far from zero as its value says.
void CrossingArming::fire_at_zero(std::size_t k, int from) {
  double& error = present_->note(k).location;
  error = std::max(error, thresholds::kept_error * std::abs(present_->g[k]));
  present_->fire(k, from);
}

bool CrossingArming::goes_against(const Firing& firing) {
  const std::size_t k = firing.guard();
  const Guard& guard = (*guards_)[k];
  const GuardGroup& group = group_of(k);
  const bool waited = !std::isnan(guard.armed_at);
  if (!may_be_rounding({.armed_at_zero = waited,
                        .monitor = guard.monitor,
                        .edge = guard.direction == Direction::edge_detection,
                        .opaque = group.is_opaque(),
                        .at_zero = firing.at_zero,
                        .soon = present_->t <= guard.clear_at}))
    return false;
  const double location = present_->now(k).location;
  const double flight = waited ? present_->t - guard.armed_at : 0.0;
  const Departure::Side flow =
      flow_->side_within(flight, group, static_cast<Index>(k), location, 0);
  if (!is_false_root(firing.from, guards_->g[k], {flow.side, flow.rounding})) return false;
  // The rounding of its states is larger than these bounds where a state has come from afar to be small here.
  guards_->doubt(
      k, firing.from,
      std::max({guard.error, location, flow.rounding, thresholds::wavered * guard.doubted}));
  return true;
}

}  // namespace saltus
