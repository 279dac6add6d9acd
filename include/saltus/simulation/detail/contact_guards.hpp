// Guards of blocks at rest: they are watched, carried with their surface, and released.
#pragma once

#include "saltus/simulation/detail/contact.hpp"
#include "saltus/simulation/detail/edges.hpp"
#include "saltus/simulation/detail/holds.hpp"
#include "saltus/simulation/detail/scope.hpp"

namespace saltus {

/// Operates the guard of a block at rest. The guard rests within its error, follows the lift off a
/// surface that moves, or releases its block.
class ContactGuards {
 public:
  ContactGuards(const Scope& scope, Machine& machine, GuardSet& guards,
                const SimulatorOptions& options, Flow& flow, Edges& edges, Holds& holds,
                const Transition& transition, Present& present);

  void begin();
  const Contacts& contacts() const noexcept { return contacts_; }

  /// Begins to watch the guard of a hold: the guard of a leaf, or a relation.
  void arm_crossing(std::size_t k);
  void arm_relation(std::size_t k);

  /// Whether a firing concerned a contact only, and whether it released a block.
  enum class Taken { no, yes, let_go };
  Taken take(const Firing& firing);
  /// Looks at the guard of a leaf on hold after a commit. On its armed side the guard releases the
  /// leaf; beyond zero its reset map is applied again.
  void look_at_held(std::size_t k);
  /// Whether a relation still has a contact.
  bool still_at_rest(std::size_t k);
  /// Ends the contact of a relation that has turned, or whose block does not rest any more.
  void leave(std::size_t k);
  /// The relations that decide an edge keep their truth, because their values at rest are rounding.
  void keep_relations_of(int edge);

  /// Ends the holds whose states the present pass has written, and arms their guards anew.
  void release_kicked();
  enum class Unseen { by_mode, by_control };
  /// Ends the holds whose guards are not seen any more. A leaf that has entered another mode may move
  /// there. A leaf that is not executed stays as it is, at rest, but no surface moves it.
  void release_unseen(Unseen why);

  /// What is known of the contacts.
  std::vector<Continuation::Contact> save() const;
  /// Finds the contacts again, after the holds were loaded. A contact that ended at the very time of
  /// the context gives a firing.
  void load(const std::vector<Continuation::Contact>& saved);

 private:
  const GuardGroup& group_of(std::size_t k) const;
  SurfaceContact* contact_of(std::size_t k);
  SurfaceContact* contact_of_crossing(std::size_t k);
  SurfaceContact* contact_of_relation(std::size_t k);
  bool rests_on_one(std::size_t e) const;
  void arm(SurfaceContact& contact, double error);
  bool place(SurfaceContact& contact);
  bool follow_surface(SurfaceContact& contact);
  void take_over(SurfaceContact& contact, const Continuation::Contact& saved);
  bool wake(SurfaceContact& contact);
  void let_go(SurfaceContact& contact, int side);
  void release_kicked_edge(std::size_t e);
  void engage();

  const Scope* scope_;
  Machine* machine_;
  GuardSet* guards_;
  Flow* flow_;
  Edges* edges_;
  Holds* holds_;
  const Transition* transition_;
  Present* present_;
  Contacts contacts_;
};

}  // namespace saltus
