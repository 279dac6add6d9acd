// IslandRuns: the contexts of the islands, and the one context of all.
#include <algorithm>

#include "saltus/simulation/detail/island_runs.hpp"

namespace saltus {

/// The values of island k, to which its run fits.
Context IslandRuns::part_of(const Context& whole, std::size_t k) const {
  const Island& island = all_[k];
  const Context blank = Context::zero(island.layout);
  ContextValues v = blank.values();
  v.time = whole.time(), v.settled = whole.settled();
  for (std::size_t i = 0; i < islands_.leaves[k].size(); ++i) {
    const Layout::Leaf& to = island.layout->leaves[i];
    const PlanLeaf& from = plan_->leaf(islands_.leaves[k][i]);
    v.continuous_state.segment(to.x, to.nx) = whole.continuous_state().segment(from.x, from.nx);
    v.discrete_state.segment(to.z, to.nz) = whole.discrete_state().segment(from.z, from.nz);
    v.parameters.segment(to.p, to.np) = whole.parameters().segment(from.p, from.np);
    v.modes[i] = nth(whole.modes(), islands_.leaves[k][i]);
  }
  if (const Continuation* all = whole.continuation()) {
    v.continuation = std::make_shared<const Continuation>(all->islands[k]);
    v.settled = all->islands[k].settled;
  }
  if (whole.pending() != nullptr) v.pending = pending_of(*whole.pending(), k);
  return blank.with_values(v);
}

/// What waits in island k, with its own numbers of the blocks; null if nothing does.
std::shared_ptr<const PendingExecutions> IslandRuns::pending_of(const PendingExecutions& whole,
                                                                std::size_t k) const {
  const std::vector<int>& leaves = islands_.leaves[k];
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
    if (islands_.of_leaf[one.leaf] != static_cast<int>(k)) continue;
    if (schedule_ && !schedule_->is_inside(one)) continue;
    one.leaf = number(one.leaf);
    part.deliveries.push_back(one);
  }
  if (static_cast<int>(k) != queue_ && part.deliveries.empty()) return {};
  return std::make_shared<const PendingExecutions>(std::move(part));
}

/// Adds what waits in island k to what waits in the whole. Deliveries are in the order of their due
/// times, and of the islands.
void IslandRuns::add_pending(PendingExecutions& whole, const PendingExecutions& part,
                             std::size_t k) const {
  const std::vector<int>& leaves = islands_.leaves[k];
  if (static_cast<int>(k) == queue_) {
    whole.all = part.all, whole.scheduled = part.scheduled, whole.draws = part.draws;
    for (PendingExecution& one : whole.all) one.leaf = nth(leaves, one.leaf);
  }
  for (PendingDelivery one : part.deliveries) {
    one.leaf = nth(leaves, one.leaf);
    whole.deliveries.push_back(one);
  }
}

/// Refuses the context of a run with one common step: it has the records of all guards in one list.
/// Refuses deliveries of blocks in no island, too.
void IslandRuns::require_fits(const Context& context) const {
  if (context.pending() != nullptr) {
    for (const PendingDelivery& one : context.pending()->deliveries)
      if (islands_.of_leaf[one.leaf] < 0 || batch_of(*plan_, one) < 0)
        throw_no_such_wire(*plan_, one);
  }
  const Continuation* all = context.continuation();
  if (all == nullptr || all->islands.size() == all_.size()) return;
  throw ModelError(text(
      "the context ended a run with ",
      all->islands.empty() ? std::string("one common step") : text(all->islands.size(), " islands"),
      ", this run has ", all_.size(),
      " islands; continue it with the options of that run, or take "
      "context.with_time(context.time()), which begins anew from its values"));
}

/// The values of all islands. A run that has not advanced has those with which it began.
Context IslandRuns::context() const {
  if (ends_.empty()) return begin_;
  ContextValues v = begin_.values();
  v.time = time_, v.settled = true;
  Continuation continuation;
  PendingExecutions pending;
  bool waits = false;
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const Context part = all_[k].run->context();
    if (part.continuation() == nullptr) return begin_;  // an island ended before its first instant
    for (std::size_t i = 0; i < islands_.leaves[k].size(); ++i) {
      const int leaf = islands_.leaves[k][i];
      if (islands_.of_leaf[leaf] != static_cast<int>(k)) continue;  // a copy
      const Layout::Leaf& from = all_[k].layout->leaves[i];
      const PlanLeaf& to = plan_->leaf(leaf);
      v.continuous_state.segment(to.x, to.nx) = part.continuous_state().segment(from.x, from.nx);
      v.discrete_state.segment(to.z, to.nz) = part.discrete_state().segment(from.z, from.nz);
      nth(v.modes, leaf) = part.modes()[i];
    }
    v.settled = v.settled && part.settled();
    continuation.jump += part.continuation()->jump;
    continuation.islands.push_back(*part.continuation());
    continuation.islands.back().settled = part.settled();
    if (part.pending() != nullptr) add_pending(pending, *part.pending(), k), waits = true;
  }
  v.pending = nullptr;
  if (schedule_) {
    const auto sent = schedule_->waiting(time_);
    pending.deliveries.insert(pending.deliveries.end(), sent.begin(), sent.end());
    waits = waits || !sent.empty();
  }
  if (waits) {
    std::ranges::stable_sort(pending.deliveries, {}, &PendingDelivery::due);
    v.pending = std::make_shared<const PendingExecutions>(std::move(pending));
  }
  v.continuation = std::make_shared<const Continuation>(std::move(continuation));
  return begin_.with_values(v);
}

}  // namespace saltus
