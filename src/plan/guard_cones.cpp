#include "guard_cones.hpp"

#include <algorithm>
#include <utility>

#include "saltus/plan/detail/leaf_function.hpp"

namespace saltus::detail {

namespace {

/// [nodes] that the cones of all groups may have, for each node and each group: those of a long chain
/// of blocks with a guard each would have n squared.
constexpr std::size_t cone_room = 8;

/// Searches the cones one after the other.
class ConeSearch {
 public:
  explicit ConeSearch(const Plan& plan)
      : plan_(plan),
        place_(plan.nodes.size(), -1),
        seen_(plan.nodes.size(), 0),
        room_(cone_room * (plan.nodes.size() + plan.guards.size())) {
    const Walk& walk = plan.walks.guards;
    int place = 0;
    const auto add = [&](const std::vector<int>& nodes) {
      for (const int i : nodes) place_[i] = place++;
    };
    if (!walk.fuses()) add(plan.needs.guards);
    for (const Walk::Stage& stage : walk.stages) {
      place += stage.fused ? 1 : 0;
      add(stage.calls);
    }
    for (const int i : walk.nodes) place_[i] = fused;
  }

  /// The cone of a group that is not fused itself.
  GuardCone of(const GuardGroup& group) {
    GuardCone cone{.whole = false};
    ++search_;
    push(nodes_read(plan_, group));
    while (!open_.empty()) {
      const int i = std::exchange(open_.back(), 0);
      open_.pop_back();
      if (plan_.node(i).rate != Rate::continuous) continue;  // not computed again
      if (place_[i] == fused || room_ == 0) return open_.clear(), GuardCone{};
      --room_;
      if (place_[i] >= 0) cone.calls.push_back(place_[i]);
      push(plan_.node(i).needs);
    }
    std::ranges::sort(cone.calls);
    return cone;
  }

 private:
  static constexpr int fused = -2;

  void push(const std::vector<int>& nodes) {
    for (const int i : nodes)
      if (std::exchange(seen_[i], search_) != search_) open_.push_back(i);
  }

  const Plan& plan_;
  List<int> place_;  // of each node among the calls; -1: it has none
  List<int> seen_;   // the number of the search that saw a node
  std::size_t room_;
  int search_ = 0;
  std::vector<int> open_;
};

}  // namespace

List<GuardCone> guard_cones(const Plan& plan) {
  List<GuardCone> cones(plan.guards.size());
  if (plan.guards.size() < 2 || plan.needs.guards.empty()) return cones;
  const Walk& walk = plan.walks.guards;
  ConeSearch search(plan);
  for (std::size_t i = 0; i < cones.size(); ++i)
    if (!walk.fuses() || !walk.fused[i]) cones[i] = search.of(plan.guards[i]);
  return cones;
}

}  // namespace saltus::detail
