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
  if (whole.pending() != nullptr && static_cast<int>(k) == queue_) {
    PendingExecutions pending = *whole.pending();
    for (PendingExecution& one : pending.all)
      one.leaf = static_cast<int>(std::ranges::find(islands_.leaves[k], one.leaf) -
                                  islands_.leaves[k].begin());
    v.pending = std::make_shared<const PendingExecutions>(std::move(pending));
  }
  return blank.with_values(v);
}

/// Refuses the context of a run with one common step: it has the records of all guards in one list.
void IslandRuns::require_fits(const Context& context) const {
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
    if (static_cast<int>(k) == queue_ && part.pending() != nullptr) {
      PendingExecutions pending = *part.pending();
      for (PendingExecution& one : pending.all) one.leaf = nth(islands_.leaves[k], one.leaf);
      v.pending = std::make_shared<const PendingExecutions>(std::move(pending));
    }
  }
  v.continuation = std::make_shared<const Continuation>(std::move(continuation));
  return begin_.with_values(v);
}

}  // namespace saltus
