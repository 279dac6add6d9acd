// Transition: what an instant has changed.
#include <algorithm>
#include <tuple>

#include "saltus/simulation/detail/transition.hpp"

namespace saltus {

bool Transition::changed_in_pass(int leaf) const {
  const PlanLeaf& of = machine_->plan().leaf(leaf);
  return modes_next_[leaf] != machine_->modes[leaf] ||
         !std::equal(z_next_.data() + of.z, z_next_.data() + of.z + of.nz,
                     machine_->z.data() + of.z);
}

/// A held output that depends on z only is found by its value. An output that also reads x or t is
/// not.
bool derivatives_read(const Plan& plan, Reads kind, int number) {
  const PlanLeaf& of = plan.leaf(number);
  const auto shows = [&](int i) {
    const Node& node = plan.node(i);
    return node.leaf == number && !node.relation && has(plan.output_of(node).reads, kind);
  };
  return (of.nx > 0 && has(of.declared().continuous.reads, kind)) ||
         std::ranges::any_of(plan.needs.derivatives, shows);
}

bool Transition::changed(const Place& place) const {
  if (place.space == Space::p) return false;
  const auto& [before, now] = place.space == Space::x   ? std::tie(x_minus_, machine_->x)
                              : place.space == Space::z ? std::tie(z_minus_, machine_->z)
                                                        : std::tie(y_minus_, machine_->y);
  return before.segment(place.offset, place.size) != now.segment(place.offset, place.size);
}

bool Transition::held_outputs_changed() const {
  const Plan& plan = machine_->plan();
  return std::ranges::any_of(plan.needs.instants, [&](int i) {
    return plan.node(i).rate == Rate::held && changed(plan.node(i).place);
  });
}

bool Transition::restarts() const {
  const Plan& plan = machine_->plan();
  return restarts_ || std::ranges::any_of(plan.needs.restarting,
                                          [&](int node) { return changed(plan.node(node).place); });
}

}  // namespace saltus
