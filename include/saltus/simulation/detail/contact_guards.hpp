// Guards of blocks at rest: watched, carried with their surface, let go.
#pragma once

#include "saltus/simulation/detail/contact.hpp"
#include "saltus/simulation/detail/edges.hpp"
#include "saltus/simulation/detail/holds.hpp"

namespace saltus {

/// What the guard of a block at rest does: it waits within its error, follows the lift off a
/// surface that moves, or lets its block go.
class ContactGuards {
 public:
  ContactGuards(Machine& machine, GuardSet& guards, const SimulatorOptions& options, Flow& flow,
                Edges& edges, Holds& holds, const Transition& transition, Present& present);

  void begin();
  const Contacts& contacts() const noexcept { return contacts_; }

  /// A hold of a leaf's guard, or of relations, is watched from here on.
  void arm_crossing(std::size_t k);
  void arm_relation(std::size_t k);

  /// Whether a firing concerned a contact only, and whether that let a block go.
  enum class Taken { no, yes, let_go };
  Taken take(const Firing& firing);
  /// After a commit, the guard of a leaf on hold: off to its armed side it lets go, beyond zero the
  /// reset map is applied again.
  void look_at_held(std::size_t k);
  /// Whether a relation has a contact that is still one.
  bool still_at_rest(std::size_t k);
  /// The relation of a contact has turned, or its block does not rest any more.
  void leave(std::size_t k);
  /// The relations that decide an edge keep their truth: at rest their values are rounding.
  void keep_relations_of(const EdgeWatch& edge);

  /// Holds whose states the pass to be committed has written end. Their guards are armed anew.
  void release_kicked();
  /// Holds of leaves that have entered a mode which does not see the guard of the hold end.
  void release_unseen();

  /// After the holds were loaded: contacts are found again.
  void load();

 private:
  const GuardGroup& group_of(std::size_t k) const;
  SurfaceContact* contact_of(std::size_t k);
  SurfaceContact* contact_of_crossing(std::size_t k);
  SurfaceContact* contact_of_relation(std::size_t k);
  bool rests_on(std::size_t e, int node) const;
  void arm(SurfaceContact& contact, double error);
  bool follow_surface(SurfaceContact& contact);
  bool wake(SurfaceContact& contact);
  void let_go(SurfaceContact& contact);
  void release_kicked_edge(std::size_t e);
  void engage();

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
