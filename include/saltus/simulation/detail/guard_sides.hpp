// GuardSides: which guards can fire, and on which side each of them is, from pass to pass.
#pragma once

#include "saltus/simulation/detail/crossing_arming.hpp"
#include "saltus/simulation/detail/relations.hpp"

namespace saltus {

/// Goes through the active guards: at the begin of an instant, after each pass, and before integration
/// continues. The decisions are those of pass_decisions.hpp, CrossingArming, Relations and ContactGuards.
class GuardSides {
 public:
  GuardSides(const Scope& scope, Machine& machine, GuardSet& guards, Flow& flow, const Holds& holds,
             ContactGuards& contacts, Relations& relations, CrossingArming& crossings,
             Present& present)
      : scope_(&scope),
        machine_(&machine),
        guards_(&guards),
        flow_(&flow),
        holds_(&holds),
        contacts_(&contacts),
        relations_(&relations),
        crossings_(&crossings),
        present_(&present) {}

  /// Chooses the guards that the present modes and control signals see.
  void select();
  /// Chooses the guards anew if a control signal has changed; returns whether one has. A guard that is
  /// seen again is armed like a guard whose mode is entered.
  bool follow_controls();
  /// Looks at the first values of a run. A zero crossing off zero is on its side.
  void see_first();
  /// A guard may be at zero within the resolution of the root of another one. The flow decides its
  /// side; a guard that the flow takes to its firing side has not crossed yet.
  void turn_beside_root();
  /// Zero crossings that the commit moved across zero in their direction fire in the next pass.
  void find_next();
  /// Arms all active guards for the solver. A guard at zero, or a guard that just fired, gets its
  /// side from the flow.
  void arm(bool at_start);

 private:
  /// Whether nothing is to be decided about a zero crossing: it is on its side, nothing is known of it in
  /// this instant, and no block is at rest. With many guards most are such at each event.
  [[gnu::always_inline]] bool is_untouched(std::size_t k) const {
    return !present_->has_facts(k) && (*guards_)[k].stays(present_->g[k]) && !holds_->any();
  }
  const Plan& plan() const { return machine_->plan(); }
  bool stays_at_root(std::size_t k) const;
  void look_at_crossing(std::size_t k);
  bool waits_at_zero(std::size_t k);
  bool left_zero_beside_root(std::size_t k);
  void continue_beside_root(std::size_t k);
  void arm_crossing(std::size_t k, bool at_start);
  void mark_armed_at(std::size_t k);
  void forget_firing(std::size_t k);

  const Scope* scope_;
  Machine* machine_;
  GuardSet* guards_;
  Flow* flow_;
  const Holds* holds_;
  ContactGuards* contacts_;
  Relations* relations_;
  CrossingArming* crossings_;
  Present* present_;
};

}  // namespace saltus
