// Arming of zero crossings: how the instant, or the guard's own reset map, turns the flow.
#include <algorithm>

#include "saltus/simulation/detail/crossing_arming.hpp"

namespace saltus {

/// Whether the guard's own reset map, applied to the present state, turns the flow to the side
/// `from`.
bool CrossingArming::reset_turns(const GuardGroup& group, std::size_t k, int from) {
  const PlanLeaf& of = machine_->plan().leaf(group.leaf);
  trial_ = machine_->x, trial_z_ = machine_->z;
  machine_->evaluate_instant(present_->t);
  At at = machine_->at(group.leaf, present_->t, machine_->x.data());
  at.entry = (*guards_)[k].entry;
  int mode = at.mode;
  Next next({trial_.data() + of.x, of.nx}, {trial_z_.data() + of.z, of.nz}, mode, of.path);
  machine_->plan().crossing_of(group).reset_map(*of.system, at, next);
  return from * flow_->slope_from(trial_, group, static_cast<Index>(k)) > 0.0;
}

/// dg/dt along the flow of the present state by the modes and the held signals before the instant.
/// The guard is that of the present mode: outside of it, it is not called.
double CrossingArming::slope_before(const GuardGroup& group, std::size_t k) {
  struct AsBefore {
    explicit AsBefore(Transition& of) : transition(of) { transition.swap_with_before(); }
    ~AsBefore() { transition.swap_with_before(); }
    Transition& transition;
  };
  flow_before_.resize(machine_->x.size());
  {
    const AsBefore before(*transition_);
    machine_->derivative(present_->t, machine_->x.data(), flow_before_.data());
  }
  return flow_->slope_along(flow_before_, group, static_cast<Index>(k));
}

/// Whether the flow before led a guard at zero to the other side. If so, both flows lead to the same
/// surface.
bool CrossingArming::turned_round(const GuardGroup& group, std::size_t k, int side) {
  return side * slope_before(group, k) < 0.0;
}

/// Whether nothing that moves a guard moved before.
bool CrossingArming::stood_still(const GuardGroup& group, std::size_t k) {
  if (slope_before(group, k) != 0.0) return false;
  return std::ranges::all_of(group.leaves, [this](int leaf) {
    const PlanLeaf& of = machine_->plan().leaf(leaf);
    return (flow_before_.segment(of.x, of.nx).array() == 0.0).all();
  });
}

}  // namespace saltus
