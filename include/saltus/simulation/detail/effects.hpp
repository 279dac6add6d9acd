// Effects: the actions of a pass, carried out and logged.
#pragma once

#include <string>

#include "saltus/simulation/detail/contact_guards.hpp"
#include "saltus/simulation/detail/deliveries.hpp"
#include "saltus/simulation/detail/executions.hpp"

namespace saltus {

/// Runs the reset maps, the changes of mode and the updates of a pass. The values that they write
/// are committed later, together. Each is logged, and the Zeno monitor of its guard or edge counts
/// it if it wrote.
class Effects {
 public:
  Effects(const Plan& plan, const GuardSet& guards, const Edges& edges, Holds& holds,
          ContactGuards& contacts, Executions& executions, Deliveries& deliveries,
          Transition& transition, Journal& journal, Present& present)
      : plan_(&plan),
        guards_(&guards),
        edges_(&edges),
        holds_(&holds),
        contacts_(&contacts),
        executions_(&executions),
        deliveries_(&deliveries),
        transition_(&transition),
        journal_(&journal),
        present_(&present) {}

  void run(const Action& action);

 private:
  struct Effect {
    const ResetMap* map;
    const int* end_mode;  // null: none
    Holds::Hold* hold;
    bool reads_before = false;
    bool yields = false;  // to the events of the leaf that came before in this pass
  };

  void run_update(const Action& action, int source);
  void run_execution(const Action& action);
  void run_reset(const Action& action, int source);
  Effect effect_of(const Action& action);
  bool write(const Effect& effect, int leaf, const std::string& source);
  void note(const Action& action, int source);

  const Plan* plan_;
  const GuardSet* guards_;
  const Edges* edges_;
  Holds* holds_;
  ContactGuards* contacts_;
  Executions* executions_;
  Deliveries* deliveries_;
  Transition* transition_;
  Journal* journal_;
  Present* present_;
};

}  // namespace saltus
