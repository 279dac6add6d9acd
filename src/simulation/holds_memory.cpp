// Holds: their part of a continuation.
#include <algorithm>
#include <functional>

#include "saltus/simulation/detail/holds.hpp"

namespace saltus {

namespace {

/// Whether entries increase, and all are among those of a leaf.
bool are_of(const PlanLeaf& leaf, std::span<const Index> entries) {
  return entries.empty() ||
         (std::ranges::adjacent_find(entries, std::greater_equal<>()) == entries.end() &&
          entries.front() >= leaf.x && entries.back() < leaf.x + leaf.nx);
}

/// The entries of x that rested in the earlier run, or would have. They may differ from those of
/// this plan: the earlier run may have known more, or less, of what the effect writes. Contexts of
/// earlier versions do not say.
std::span<const Index> states_of(const Holds::Hold& hold, const Continuation::Firings& saved) {
  return saved.states.empty() ? hold.of_plan : std::span<const Index>(saved.states);
}

/// A firing that left other states than the hold has, or a hold where nothing can rest, comes from
/// a damaged context.
void require_sound(const Plan& plan, const Holds::Hold& hold, const Continuation::Firings& saved) {
  const std::size_t size = states_of(hold, saved).size();
  const bool whole = saved.after.empty() || saved.after.size() == size;
  const bool possible = hold.leaf >= 0
                            ? are_of(plan.leaf(hold.leaf), saved.states)
                            : !saved.holding && saved.times.empty() && saved.states.empty();
  if (whole && possible) return;
  throw ModelError(text("the continuation of the context is damaged: a guard with ", size,
                        " states that may rest has ", saved.after.size(),
                        " states after its last firing",
                        possible ? "" : ", or others than those of its block"));
}

}  // namespace

std::vector<Continuation::Firings> Holds::save() const {
  std::vector<Continuation::Firings> firings;
  for (const auto* holds : {&of_guards_, &of_edges_}) {
    for (const Hold& hold : *holds) {
      Continuation::Firings& saved = firings.emplace_back(hold.monitor.save());
      if (!saved.times.empty() || saved.holding)
        saved.states.assign(hold.states.begin(), hold.states.end());
    }
  }
  return firings;
}

bool Holds::fits(const Continuation& from) const {
  if (from.firings.size() != of_guards_.size() + of_edges_.size()) return false;
  auto firings = from.firings.begin();
  for (const auto* holds : {&of_guards_, &of_edges_}) {
    for (const Hold& hold : *holds) require_sound(machine_->plan(), hold, *firings++);
  }
  return true;
}

void Holds::load(const Continuation& from) {
  auto firings = from.firings.begin();
  for (auto* holds : {&of_guards_, &of_edges_}) {
    for (Hold& hold : *holds) load(hold, *firings++);
  }
}

void Holds::load(Hold& hold, const Continuation::Firings& saved) {
  if (!std::ranges::equal(states_of(hold, saved), hold.of_plan)) {
    hold.earlier = saved.states;
    hold.states = hold.earlier;
  }
  hold.monitor.load(saved, hold.states.size());
  if (!hold.monitor.holding) return;
  ++count_;
  for (const Index i : hold.states) machine_->resting().rest(i);
}

}  // namespace saltus
