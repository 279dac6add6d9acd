// Holds: which states rest, and from when until when.
#include "saltus/simulation/detail/holds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saltus/base/list.hpp"
#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

void Holds::begin() {
  for (auto* holds : {&of_guards_, &of_edges_}) {
    for (Hold& hold : *holds) hold.monitor.forget(), hold.states = hold.of_plan;
  }
  count_ = 0;
  open();
}

void Holds::open() {
  for (Hold* hold : changed_) hold->changed = false;
  changed_.clear();
}

void Holds::undo() {
  for (Hold* hold : changed_) {
    count_ += static_cast<int>(hold->before.holding) - static_cast<int>(hold->monitor.holding);
    hold->monitor = hold->before;
  }
  open();
}

/// The monitor of a hold, to be changed. The first change in an instant keeps a copy.
ZenoMonitor& Holds::changing(Hold& hold) {
  if (!std::exchange(hold.changed, true)) {
    hold.before = hold.monitor;
    changed_.push_back(&hold);
  }
  return hold.monitor;
}

void Holds::fired(Hold& hold, double t) {
  changing(hold).fired(t);
  if (Tangents* tangents = transition_->tangents()) tangents->fired(&hold);
}

bool Holds::kicked(const Hold& hold) const {
  return hold.monitor.holding && std::ranges::any_of(hold.states, [&](Index i) {
           return transition_->next()[i] != machine_->x[i];
         });
}

void Holds::come_to_rest(Hold& hold, double predicted, bool in_pass) {
  using Kind = OnZeno::Kind;
  const Kind kind = hold.on_zeno.kind();
  const bool there = kind == Kind::mode && machine_->modes[hold.leaf] == hold.on_zeno.mode();
  if (kind == Kind::hold || there) return rest(hold, predicted);
  if (kind == Kind::stop && present_->outcome.zeno_stop) return;
  if (kind == Kind::error) throw_accumulation(hold, predicted);
  journal_->note({.kind = EventKind::zeno_enter,
                  .source = hold.source,
                  .leaf = hold.leaf,
                  .predicted = predicted,
                  .entry = hold.entry});
  changing(hold).forget();
  if (kind == Kind::stop)
    present_->outcome.zeno_stop = true;
  else if (in_pass)
    transition_->enter_mode(hold.leaf, hold.on_zeno.mode());
  else
    present_->actions.push_back(
        {hold.leaf, Cause::zeno, hold.source, -1, hold.on_zeno.mode(), false});
}

void Holds::throw_accumulation(const Hold& hold, double predicted) const {
  throw SimulationError(
      text("t = ", present_->t, " s: the firings of '", journal_->name_of(hold.source),
           "' accumulate at t = ", predicted,
           " s (a Zeno point), and its on_zeno is \"error\"; choose \"hold\", \"stop\" or a mode "
           "to go on in"),
      present_->t, machine_->plan().leaf(hold.leaf).path);
}

void Holds::rest(Hold& hold, double predicted) {
  changing(hold).holding = true, ++count_;
  for (const Index i : hold.states) machine_->resting().rest(i);
  present_->outcome.horizon = std::numeric_limits<double>::infinity();
  present_->outcome.restart = true;
  flow_->forget();
  journal_->note({.kind = EventKind::zeno_enter,
                  .source = hold.source,
                  .leaf = hold.leaf,
                  .predicted = predicted,
                  .entry = hold.entry,
                  .rests = hold.states});
}

void Holds::release(Hold& hold) {
  changing(hold).forget(), --count_;
  for (const Index i : hold.states) machine_->resting().move(i);
  present_->outcome.restart = true;
  flow_->forget();
  journal_->note({.kind = EventKind::zeno_release,
                  .source = hold.source,
                  .leaf = hold.leaf,
                  .entry = hold.entry});
}

/// Whether the reset has left a guard of the hold at zero, within the tolerance of the run. If the
/// guard is clearly off zero, nothing has come to rest, however short and shrinking the gaps are
/// (4.2). The value of a guard that jumps, or that is not finite, says nothing about that.
bool Holds::left_at_zero(const Hold& hold) {
  values_.resize(static_cast<std::size_t>(machine_->plan().look_slots));
  transition_->guards_after(hold.groups, present_->t, values_.data());
  const bool found = std::ranges::any_of(hold.groups, [&](int k) {
    const GuardGroup& group = machine_->plan().guard(k);
    const Index first = group.is_crossing() ? group.slot + hold.entry : group.slot,
                last = group.is_crossing() ? first + 1 : first + group.size;
    for (Index slot = first; slot < last; ++slot) {
      const double g = nth(values_, slot);
      if (group.is_opaque() || !std::isfinite(g)) return true;
      if (present_->now(static_cast<std::size_t>(slot)).jumped()) return true;
      if (std::abs(g) <= flow_->tolerance(slot, false)) return true;
    }
    return false;
  });
  flow_->forget();
  return found;
}

bool Holds::accumulates(const Hold& hold) {
  if (!hold.monitor.on() || !hold.monitor.accumulates()) return false;
  return hold.groups.empty() || left_at_zero(hold);
}

bool Holds::look_for_accumulation(Hold& hold) {
  Eigen::VectorXd& next = transition_->next();
  if (!accumulates(hold)) {
    if (Tangents* tangents = transition_->tangents()) tangents->remember(&hold, hold.states, next);
    changing(hold).remember(parts_.gather(hold.states, next, gathered_));
    double& horizon = present_->outcome.horizon;
    if (const double gap = hold.monitor.gap(); std::isfinite(gap))
      horizon = std::min(horizon, std::max(thresholds::next_gap * gap, present_->least_time()));
    return false;
  }
  gathered_ = parts_.gather(hold.states, next, gathered_);
  if (Tangents* tangents = transition_->tangents()) tangents->accumulate(&hold, hold.states, next);
  hold.monitor.accumulate(gathered_);
  for (std::size_t i = 0; i < hold.states.size(); ++i)
    next[hold.states[i]] = gathered_[static_cast<Index>(i)];
  come_to_rest(hold, hold.monitor.accumulation_time(), true);
  return hold.monitor.holding;
}

bool Holds::hold_edges(const std::vector<int>& edges, int node) {
  bool all = true;
  for (const int e : edges) {
    const std::vector<int>& relations = machine_->plan().edge(e).relations;
    Hold& hold = of_edges_[e];
    if (hold.monitor.holding || std::ranges::find(relations, node) == relations.end()) continue;
    if (hold.monitor.on())
      come_to_rest(hold, present_->t, false);
    else
      all = false;
  }
  return all;
}

}  // namespace saltus
