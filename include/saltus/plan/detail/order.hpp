// Feedthrough order of the nodes of a plan.
#pragma once

#include <span>

#include "saltus/model/detail/feedthrough_order.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus::detail {

/// Puts the nodes of a plan in order. A located relation is held, so it needs nothing and breaks
/// loops.
inline std::vector<int> order_of(const Plan& plan) {
  const auto needs = [&](int i) {
    const Node& node = plan.node(i);
    return node.relation && node.located ? std::span<const int>()
                                         : std::span<const int>(node.needs);
  };
  const auto name = [&](int i) { return plan.name_of(plan.node(i)); };
  return FeedthroughOrder(plan.nodes.size(), needs, name).run();
}

inline void add_order(Plan& plan) { plan.order = order_of(plan); }

}  // namespace saltus::detail
