// The signals behind called guards, which are looked at with them.
#include <algorithm>
#include <vector>

#include "saltus/plan/detail/leaf_function.hpp"
#include "saltus/plan/detail/passes.hpp"

namespace saltus {

namespace {

/// [values] Of more than the nearest of them, many guards of one large diagram would take the product of
/// both numbers.
constexpr std::size_t most_reads = 32;

/// The nearest entries of some signals. A view of a state has none: the steps show it.
std::vector<Place> entries_of(const Plan& plan, const std::vector<int>& nodes) {
  std::vector<Place> places;
  for (const int i : nodes) {
    const Place& all = plan.node(i).place;
    for (Index k = 0; !plan.node(i).view && k < all.size && places.size() < most_reads; ++k)
      places.push_back({all.space, all.offset + k, 1});
  }
  return places;
}

std::vector<int> nodes_read(const Plan& plan, const GuardGroup& group) {
  return group.is_crossing() ? nodes_of_guard(plan, group) : plan.node(group.index).needs;
}

}  // namespace

std::vector<int> detail::signals_behind(const Plan& plan, const std::vector<int>& nodes) {
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

void detail::add_reads_of_guards(Plan& plan) {
  const List<char>& fused = plan.walks.guards.fused;
  plan.look_slots = plan.guard_slots;
  for (std::size_t i = 0; i < plan.guards.size(); ++i) {
    GuardGroup& group = plan.guards[i];
    if (!fused.empty() && fused[i]) continue;
    for (const Place& place : entries_of(plan, signals_behind(plan, nodes_read(plan, group))))
      group.reads.push_back({plan.look_slots++, place});
  }
}

}  // namespace saltus
