// Scope: the lists of a whole scene.
#include "saltus/simulation/detail/scope.hpp"

#include <algorithm>

namespace saltus {

namespace {

/// Adds the guard of a relation to the edges that it decides, and these edges to the guard.
void link(Scope& scope, const Plan& plan, std::size_t guard, int relation) {
  for (const std::size_t e : scope.edges) {
    const List<int>& of_edge = plan.edge(e).relations;
    if (std::ranges::find(of_edge, relation) == of_edge.end()) continue;
    scope.deciders[e].push_back(guard);
    scope.decided[guard].push_back(e);
  }
}

}  // namespace

Scope::Scope(const Plan& plan) : deciders(plan.edges.size()), decided(plan.guard_slots) {
  for (std::size_t e = 0; e < plan.edges.size(); ++e) edges.push_back(e);
  for (const GuardGroup& group : plan.guards) {
    for (Index slot = group.slot; slot < group.slot + group.size; ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      (group.is_crossing() ? crossings : relations).push_back(k);
      if (!group.is_crossing()) link(*this, plan, k, group.index);
    }
  }
}

}  // namespace saltus
