// Collector: the actions of the next pass, from the guards that fired and the signals that changed.
#pragma once

#include "saltus/simulation/detail/crossing_arming.hpp"
#include "saltus/simulation/detail/relations.hpp"

namespace saltus {

/// Turns firings into actions. `Instant` calls its functions in this order in each pass, because
/// edges are those of the held signals after the relations flipped.
class Collector {
 public:
  Collector(const Scope& scope, const Plan& plan, GuardSet& guards, Edges& edges, Holds& holds,
            ContactGuards& contacts, Relations& relations, CrossingArming& crossings,
            const Transition& transition, Journal& journal, Present& present)
      : scope_(&scope),
        plan_(&plan),
        guards_(&guards),
        edges_(&edges),
        holds_(&holds),
        contacts_(&contacts),
        relations_(&relations),
        crossings_(&crossings),
        transition_(&transition),
        journal_(&journal),
        present_(&present) {}

  /// Removes the firings of contacts, and the firings against the flow, from the list. True if a
  /// contact released a block.
  bool take_contacts();
  /// Flips the relations that fired. True if there is one.
  bool flip_relations();
  /// Whether a zero crossing that fired jumped at its root.
  bool some_jumped() const;
  /// Removes those of them that came back when the relations of the same root flipped.
  void take_back_jumps();
  /// Collects the edges of watched signals. True if a falling edge ended a hold.
  bool collect_edges();
  /// Collects the zero crossings that act in this pass, and sorts all actions. A zero crossing that
  /// follows updates acts in the pass after the updates.
  void collect_crossings();
  /// Whether some action counts as a change.
  bool acts() const;
  /// Logs the zero crossings that fire and do nothing.
  void note_passive();

 private:
  /// Whether the guard of a firing is a zero crossing; otherwise it is that of a relation.
  bool is_crossing(const Firing& firing) const;
  bool acts(const Action& action) const;
  /// Whether a firing waits for the updates of this pass.
  bool waits_for_updates(const GuardGroup& group) const;
  bool has_jumped(const Firing& firing) const;
  void collect_carried(std::size_t e);

  const Scope* scope_;
  const Plan* plan_;
  GuardSet* guards_;
  Edges* edges_;
  Holds* holds_;
  ContactGuards* contacts_;
  Relations* relations_;
  CrossingArming* crossings_;
  const Transition* transition_;
  Journal* journal_;
  Present* present_;
  std::vector<Firing> waiting_;  // for the pass after the updates
};

}  // namespace saltus
