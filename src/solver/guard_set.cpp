// GuardSet: made from a plan, cleared for a run, chosen by mode.
#include "saltus/solver/detail/guard_set.hpp"

#include <utility>

namespace saltus {

GuardSet::GuardSet(const Plan& plan) {
  for (std::size_t i = 0; i < plan.guards.size(); ++i) {
    const GuardGroup& group = plan.guards[i];
    for (int entry = 0; entry < group.size; ++entry) {
      add({.direction = group.direction,
           .monitor = group.monitor,
           .jumps = group.is_opaque(),
           .group = static_cast<int>(i),
           .entry = entry},
          false);
    }
  }
}

void GuardSet::add(const GuardTraits& traits, bool active) {
  guards_.push_back({});
  static_cast<GuardTraits&>(guards_.back()) = traits;
  guards_.back().active = active;
  if (active) watch(guards_.size() - 1);
  g.push_back(1.0);
  ++version_;
}

void GuardSet::clear() {
  ++version_;
  fired_at_root.clear(), beside_root.clear(), monitors.clear(), kept_.clear();
  active_.clear(), stopping_.clear(), watching_.clear();
  for (Guard& guard : guards_) {
    const GuardTraits traits = guard;
    guard = {};
    static_cast<GuardTraits&>(guard) = traits;
  }
}

void GuardSet::select(const std::vector<int>& groups, const Plan& plan) {
  ++version_;
  active_.clear(), stopping_.clear(), watching_.clear();
  for (const int i : groups) {
    const GuardGroup& group = plan.guards[i];
    for (Index s = 0; s < group.size; ++s) watch(group.slot + s);
  }
  for (Guard& guard : guards_) guard.was_active = std::exchange(guard.active, false);
  for (const std::size_t k : active_) {
    Guard& guard = guards_[k];
    guard.active = true;
    if (guard.was_active) continue;
    guard.side = 0;
    if (guard.phase == Phase::armed || guard.phase == Phase::waiting) guard.phase = Phase::unseen;
  }
}

void GuardSet::leave_rest(std::size_t k) {
  ++version_;
  Guard& guard = guards_[k];
  if (guard.phase == Phase::resting) guard.phase = Phase::waiting;
  if (guard.phase == Phase::carried) guard.phase = Phase::armed;
}

void GuardSet::arm_again(const std::vector<Firing>& fired) {
  for (const Firing& firing : fired) {
    const std::size_t k = firing.guard();
    set(k, Phase::armed, firing.from, 0.0);
    if (k < kept_.size()) guards_[k].base = kept_[k].base;  // the value before the root
  }
}

std::vector<Continuation::Guard> GuardSet::save() const {
  std::vector<Continuation::Guard> saved;
  for (const Guard& guard : guards_)
    saved.push_back(
        {guard.side, guard.came_from, guard.at_zero(), guard.rests, guard.error, guard.base});
  return saved;
}

void GuardSet::load(const Continuation& from) {
  ++version_;
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    Guard& guard = guards_[k];
    const Continuation::Guard& saved = from.guards[k];
    set(k, saved.at_zero ? Phase::waiting : Phase::unseen, 0, saved.error);
    guard.turn(saved.side);
    guard.came_from = static_cast<signed char>(saved.from);
    guard.rests = saved.resting, guard.base = saved.base;
  }
}

}  // namespace saltus
