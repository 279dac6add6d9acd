#include "saltus/simulation/detail/island_contexts.hpp"

#include <algorithm>
#include <utility>

#include "saltus/simulation/detail/island_tangents.hpp"

namespace saltus {

void IslandContexts::add(const Plan& part) {
  for (const PlanLeaf& leaf : part.leaves) {
    if (std::ranges::any_of(leaf.declared().zero_crossings, &ZeroCrossing::is_queued))
      queue_ = static_cast<int>(layouts_.size());
  }
  layouts_.push_back(std::make_shared<const Layout>(IslandTangents::layout_of(part)));
}

Context IslandContexts::part_of(const Context& whole, std::size_t k) const {
  const Context blank = Context::zero(layouts_[k]);
  ContextValues v = blank.values();
  v.time = whole.time(), v.settled = whole.settled();
  for (std::size_t i = 0; i < islands_->leaves[k].size(); ++i) {
    const Layout::Leaf& to = layouts_[k]->leaves[i];
    const PlanLeaf& from = plan_->leaf(islands_->leaves[k][i]);
    v.continuous_state.segment(to.x, to.nx) = whole.continuous_state().segment(from.x, from.nx);
    v.discrete_state.segment(to.z, to.nz) = whole.discrete_state().segment(from.z, from.nz);
    v.parameters.segment(to.p, to.np) = whole.parameters().segment(from.p, from.np);
    v.modes[i] = nth(whole.modes(), islands_->leaves[k][i]);
  }
  if (const Continuation* all = whole.continuation()) {
    v.continuation = std::make_shared<const Continuation>(all->islands[k]);
    v.settled = all->islands[k].settled;
  }
  if (whole.pending() != nullptr) v.pending = pending_of(*whole.pending(), k);
  return blank.with_values(v);
}

/// What waits in island k, with its own numbers of the blocks; null if nothing does.
std::shared_ptr<const PendingExecutions> IslandContexts::pending_of(const PendingExecutions& whole,
                                                                    std::size_t k) const {
  const std::vector<int>& leaves = islands_->leaves[k];
  const auto number = [&](int leaf) {
    return static_cast<int>(std::ranges::lower_bound(leaves, leaf) - leaves.begin());
  };
  PendingExecutions part;
  if (static_cast<int>(k) == queue_) {
    part = whole;
    part.deliveries.clear();
    for (PendingExecution& one : part.all) one.leaf = number(one.leaf);
  }
  for (PendingDelivery one : whole.deliveries) {
    if (islands_->of_leaf[one.leaf] != static_cast<int>(k)) continue;
    if (schedule_ != nullptr && !schedule_->is_inside(one)) continue;
    one.leaf = number(one.leaf);
    part.deliveries.push_back(one);
  }
  if (static_cast<int>(k) != queue_ && part.deliveries.empty()) return {};
  return std::make_shared<const PendingExecutions>(std::move(part));
}

/// Adds what waits in island k to what waits in the whole. Deliveries are in the order of their due
/// times, and of the islands.
void IslandContexts::add_pending(PendingExecutions& whole, const PendingExecutions& part,
                                 std::size_t k) const {
  const std::vector<int>& leaves = islands_->leaves[k];
  if (static_cast<int>(k) == queue_) {
    whole.all = part.all, whole.scheduled = part.scheduled, whole.draws = part.draws;
    for (PendingExecution& one : whole.all) one.leaf = nth(leaves, one.leaf);
  }
  for (PendingDelivery one : part.deliveries) {
    one.leaf = nth(leaves, one.leaf);
    whole.deliveries.push_back(one);
  }
}

void IslandContexts::require_fits(const Context& whole) const {
  if (whole.pending() != nullptr) {
    for (const PendingDelivery& one : whole.pending()->deliveries)
      if (islands_->of_leaf[one.leaf] < 0 || batch_of(*plan_, one) < 0)
        throw_no_such_wire(*plan_, one);
  }
  const Continuation* all = whole.continuation();
  if (all == nullptr || all->islands.size() == layouts_.size()) return;
  throw ModelError(text(
      "the context ended a run with ",
      all->islands.empty() ? std::string("one common step") : text(all->islands.size(), " islands"),
      ", this run has ", layouts_.size(),
      " islands; continue it with the options of that run, or begin anew from its values: set its "
      "time to the same value by with_time"));
}

Context IslandContexts::whole_of(const Context& begin, double t,
                                 const std::vector<Context>& parts) const {
  ContextValues v = begin.values();
  v.time = t, v.settled = true;
  Continuation continuation;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Context& part = parts[k];
    if (part.continuation() == nullptr) return begin;
    write_values(v, part, k);
    v.settled = v.settled && part.settled();
    continuation.jump += part.continuation()->jump;
    continuation.islands.push_back(*part.continuation());
    continuation.islands.back().settled = part.settled();
  }
  v.pending = pending_of(t, parts);
  v.continuation = std::make_shared<const Continuation>(std::move(continuation));
  return begin.with_values(v);
}

/// Writes those of the blocks that island k owns.
void IslandContexts::write_values(ContextValues& whole, const Context& part, std::size_t k) const {
  for (std::size_t i = 0; i < islands_->leaves[k].size(); ++i) {
    const int leaf = islands_->leaves[k][i];
    if (islands_->of_leaf[leaf] != static_cast<int>(k)) continue;  // a copy
    const Layout::Leaf& from = layouts_[k]->leaves[i];
    const PlanLeaf& to = plan_->leaf(leaf);
    whole.continuous_state.segment(to.x, to.nx) = part.continuous_state().segment(from.x, from.nx);
    whole.discrete_state.segment(to.z, to.nz) = part.discrete_state().segment(from.z, from.nz);
    nth(whole.modes, leaf) = part.modes()[i];
  }
}

/// What waits in any island, or between two; null if nothing does.
std::shared_ptr<const PendingExecutions> IslandContexts::pending_of(
    double t, const std::vector<Context>& parts) const {
  PendingExecutions pending;
  bool waits = false;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].pending() != nullptr) add_pending(pending, *parts[k].pending(), k), waits = true;
  if (schedule_ != nullptr) {
    const auto sent = schedule_->waiting(t);
    pending.deliveries.insert(pending.deliveries.end(), sent.begin(), sent.end());
    waits = waits || !sent.empty();
  }
  if (!waits) return {};
  std::ranges::stable_sort(pending.deliveries, {}, &PendingDelivery::due);
  return std::make_shared<const PendingExecutions>(std::move(pending));
}

}  // namespace saltus
