// The signals that called guards read, which are looked at with them.
#include <vector>

#include "saltus/plan/detail/leaf_function.hpp"
#include "saltus/plan/detail/passes.hpp"

namespace saltus {

namespace {

/// [values] A called guard that reads more is judged by its own value alone: many guards that read one
/// long vector would take the square of its length.
constexpr std::size_t most_reads = 32;

/// A view of a state has no entry: the steps show it.
std::vector<Place> places_of_reads(const Plan& plan, const std::vector<int>& nodes) {
  std::vector<Place> places;
  for (const int i : nodes) {
    const Node& node = plan.node(i);
    if (node.rate != Rate::continuous || node.view || node.located) continue;
    for (Index k = 0; k < node.place.size && places.size() <= most_reads; ++k)
      places.push_back({node.place.space, node.place.offset + k, 1});
  }
  return places;
}

}  // namespace

void detail::add_reads_of_guards(Plan& plan) {
  const List<char>& fused = plan.walks.guards.fused;
  plan.look_slots = plan.guard_slots;
  for (std::size_t i = 0; i < plan.guards.size(); ++i) {
    GuardGroup& group = plan.guards[i];
    if (!fused.empty() && fused[i]) continue;
    const std::vector<Place> places = places_of_reads(
        plan, group.is_crossing() ? nodes_of_guard(plan, group) : plan.node(group.index).needs);
    if (places.size() > most_reads) continue;
    for (const Place& place : places) group.reads.push_back({plan.look_slots++, place});
  }
}

}  // namespace saltus
