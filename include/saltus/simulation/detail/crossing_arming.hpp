// Arming of zero crossings: their sides of zero when integration continues.
#pragma once

#include "saltus/simulation/detail/contact_guards.hpp"
#include "saltus/simulation/detail/crossing_decisions.hpp"
#include "saltus/simulation/detail/pass_decisions.hpp"

namespace saltus {

/// Collects the facts of a guard, lets crossing_decisions.hpp decide, and carries the decision out.
class CrossingArming {
 public:
  CrossingArming(Machine& machine, GuardSet& guards, Flow& flow, Holds& holds,
                 ContactGuards& contacts, Transition& transition, Present& present);

  /// Arms a guard before integration continues. It gets a side, fires at once, or comes to rest.
  void arm(std::size_t k, bool at_start);
  /// Whether a reset of this instant may have struck what is in contact, a rounding beyond zero.
  bool may_be_struck(std::size_t k) const {
    return (*guards_)[k].is_beyond() && facts_of(k, false).may_be_struck();
  }
  /// The error of a guard at the present state by the rounding of the states and of the time.
  double uncertainty(std::size_t k);
  /// Whether a guard that a commit moved across zero is at zero within its error. If so, it has not
  /// fired: the flow decides (3.4).
  bool is_at_zero(std::size_t k);
  /// Whether the flow leads a guard that seems to have fired to its armed side. The first step
  /// after a restart has order 1, or is hidden by the rounding of its states; it can show a false
  /// root while the ball still rises. Only guards that have been at zero since they were armed can
  /// have false roots. Such a guard continues to wait.
  bool goes_against(const Firing& firing);

 private:
  struct Ask;

  const GuardGroup& group_of(std::size_t k) const;
  CrossingFacts facts_of(std::size_t k, bool at_start) const;
  void arm_edge(std::size_t k);
  bool begins_as_wished(const GuardGroup& group, std::size_t k, bool at_start);
  void carry_out(std::size_t k, const Arming& arming, double error);
  void fire_at_zero(std::size_t k, int from);
  bool reset_turns(const GuardGroup& group, std::size_t k, int from);
  double slope_before(const GuardGroup& group, std::size_t k);
  bool turned_round(const GuardGroup& group, std::size_t k, int side);
  bool stood_still(const GuardGroup& group, std::size_t k);

  Machine* machine_;
  GuardSet* guards_;
  Flow* flow_;
  Holds* holds_;
  ContactGuards* contacts_;
  Transition* transition_;
  Present* present_;
  Eigen::VectorXd trial_, trial_z_, flow_before_;
};

}  // namespace saltus
