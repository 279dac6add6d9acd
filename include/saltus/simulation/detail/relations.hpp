// Relations: comparisons and booleans whose truth is held between instants.
#pragma once

#include "saltus/simulation/detail/contact_guards.hpp"
#include "saltus/simulation/detail/relation_decisions.hpp"

namespace saltus {

/// Flips the truths whose roots were found, and reads all of them again after a commit.
class Relations {
 public:
  Relations(const Scope& scope, Machine& machine, GuardSet& guards, const SimulatorOptions& options,
            Flow& flow, Edges& edges, Holds& holds, ContactGuards& contacts,
            const Transition& transition, Journal& journal, Present& present);

  /// A run begins: each truth follows the present sign. Relations may read each other.
  void begin(double t);
  /// Whether a relation that fires at its root turns back there: it waits on its side then.
  bool turns_back(const Firing& firing);
  /// A root was found: the relation takes the side of its crossing, because its value there may be
  /// exactly zero.
  void flip(const Firing& firing);
  /// Held outputs and truths follow the writes of a commit.
  void read_again();
  /// Sets the side on which a relation continues when integration does.
  void arm(std::size_t k);

  std::vector<double> save() const;
  bool fits(const Continuation& from) const;
  void load(const Continuation& from);

 private:
  bool read(const GuardGroup& group, std::size_t k);
  int side_at_zero(const GuardGroup& group, std::size_t k, const RelationFacts& facts, int side);
  int side_by_flow(const GuardGroup& group, std::size_t k, int crossed_to);
  bool reads_changed(int node) const;
  bool true_at_zero(const GuardGroup& group) const;
  double& truth(std::size_t k) const;

  const Scope* scope_;
  Machine* machine_;
  GuardSet* guards_;
  const SimulatorOptions* options_;
  Flow* flow_;
  Edges* edges_;
  Holds* holds_;
  ContactGuards* contacts_;
  const Transition* transition_;
  Journal* journal_;
  Present* present_;
};

}  // namespace saltus
