// Holds: their part of a continuation.
#include <algorithm>

#include "saltus/simulation/detail/holds.hpp"

namespace saltus {

std::vector<Continuation::Firings> Holds::save() const {
  std::vector<Continuation::Firings> firings;
  for (const auto* holds : {&of_guards_, &of_edges_}) {
    for (const Hold& hold : *holds) firings.push_back(hold.monitor.save());
  }
  return firings;
}

bool Holds::fits(const Continuation& from) const {
  if (from.firings.size() != of_guards_.size() + of_edges_.size()) return false;
  auto firings = from.firings.begin();
  for (const auto* holds : {&of_guards_, &of_edges_}) {
    for (const Hold& hold : *holds) require_sound(hold, *firings++);
  }
  return true;
}

/// A firing that left other states than the hold has, or a hold where nothing can rest, comes from
/// a damaged context.
void Holds::require_sound(const Hold& hold, const Continuation::Firings& saved) const {
  const bool whole = saved.after.empty() || saved.after.size() == hold.states.size();
  const bool possible = hold.leaf >= 0 || (!saved.holding && saved.times.empty());
  if (whole && possible) return;
  throw ModelError(text("the continuation of the context is damaged: a guard with ",
                        hold.states.size(), " states that may rest has ", saved.after.size(),
                        " states after its last firing", possible ? "" : ", or rests"));
}

void Holds::load(const Continuation& from) {
  auto firings = from.firings.begin();
  for (auto* holds : {&of_guards_, &of_edges_}) {
    for (Hold& hold : *holds) {
      hold.monitor.load(*firings++);
      if (!hold.monitor.holding) continue;
      ++count_;
      for (const Index i : hold.states) machine_->resting().rest(i);
    }
  }
}

}  // namespace saltus
