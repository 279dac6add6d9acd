// Arming of zero crossings: on which side of zero they go on when integration does.
#pragma once

#include "saltus/simulation/detail/contact_guards.hpp"
#include "saltus/simulation/detail/decisions.hpp"

namespace saltus {

/// Collects the facts of a guard, lets decisions.hpp decide, and carries the decision out.
class CrossingArming {
 public:
  CrossingArming(Machine& machine, GuardSet& guards, Flow& flow, Holds& holds,
                 ContactGuards& contacts, Transition& transition, Present& present);

  /// Before integration goes on: the side of a guard, a firing at once, or rest.
  void arm(std::size_t k, bool at_start);
  /// Whether the flow leads a guard that seems to have fired to its armed side. The first step
  /// after a restart, of order 1 or drowned in the rounding of its states, invents such roots while
  /// the ball still rises. Only guards that have been at zero since they were armed can be mistaken
  /// so. Such a guard goes on waiting.
  bool goes_against(const Firing& firing);

 private:
  struct Ask;

  const GuardGroup& group_of(std::size_t k) const;
  CrossingFacts facts_of(std::size_t k, bool at_start) const;
  bool begins_as_wished(const GuardGroup& group, std::size_t k);
  void carry_out(std::size_t k, const Arming& arming, double error);
  bool reset_turns(const GuardGroup& group, std::size_t k);
  bool turned_round(const GuardGroup& group, std::size_t k, int side);

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
