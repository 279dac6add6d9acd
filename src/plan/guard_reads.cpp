// The signals behind guards that may be constant, which are looked at with them.
#include <algorithm>
#include <vector>

#include "saltus/plan/detail/leaf_function.hpp"
#include "saltus/plan/detail/needs.hpp"
#include "saltus/plan/detail/passes.hpp"
#include "stepwise.hpp"

namespace saltus {

namespace {

using detail::Stepwise, detail::append;

/// [values] Of more than the nearest of them, many guards of one large diagram would take the product of
/// both numbers.
constexpr std::size_t most_reads = 32;

/// The continuous signals among these nodes, and those from which they are computed, the nearest
/// first.
std::vector<int> signals_behind(const Plan& plan, const std::vector<int>& nodes) {
  std::vector<int> found;
  const auto add = [&](const std::vector<int>& more) {
    for (const int i : more) {
      if (plan.node(i).rate == Rate::continuous && std::ranges::find(found, i) == found.end())
        found.push_back(i);
    }
  };
  add(nodes);
  for (std::size_t k = 0; k < found.size() && found.size() < most_reads; ++k)
    add(plan.node(found[k]).needs);
  return found;
}

/// The signals that may vary while the guard is constant: those behind a function that is constant in
/// pieces, be it the guard or a function that it reads.
std::vector<int> hidden_behind(const Plan& plan, Stepwise& stepwise, const GuardGroup& group) {
  const std::vector<int> nodes = nodes_read(plan, group);
  if (group.stepped) return signals_behind(plan, nodes);
  std::vector<int> hidden;
  for (const int i : signals_behind(plan, nodes))
    if (stepwise.is_node(i)) append(hidden, plan.node(i).needs);
  return signals_behind(plan, hidden);
}

/// Adds the nearest entries of some signals. A state is none: the steps show it.
void add_reads(const Plan& plan, Stepwise& stepwise, const std::vector<int>& signals,
               List<ReadSlot>& reads, Index& slot) {
  for (const int i : signals) {
    const Place& all = plan.node(i).place;
    for (Index k = 0; k < all.size && reads.size() < most_reads; ++k)
      if (!stepwise.is_state(i, k)) reads.push_back({slot++, {all.space, all.offset + k, 1}, i});
  }
}

}  // namespace

void detail::add_reads_of_guards(Plan& plan) {
  Stepwise stepwise(plan);
  plan.look_slots = plan.guard_slots;
  for (GuardGroup& group : plan.guards) {
    group.stepped = stepwise.is_guard(group);
    add_reads(plan, stepwise, hidden_behind(plan, stepwise, group), group.reads, plan.look_slots);
  }
}

}  // namespace saltus
