// GuardSet: made from a plan, cleared for a run, chosen by mode.
#include "saltus/solver/detail/guard_set.hpp"

#include <cmath>
#include <utility>

namespace saltus {

GuardSet::GuardSet(std::initializer_list<GuardTraits> guards) : g(guards.size(), 1.0) {
  for (const GuardTraits& traits : guards) {
    active_.add(guards_.size(), traits);
    guards_.push_back({traits});
    guards_.back().active = true;
  }
}

GuardSet::GuardSet(const Plan& plan) : g(plan.look_slots, 1.0) {
  for (std::size_t i = 0; i < plan.guards.size(); ++i) {
    const GuardGroup& group = plan.guards[i];
    for (int entry = 0; entry < group.size; ++entry) {
      guards_.push_back({{.direction = group.direction,
                          .monitor = group.monitor,
                          .jumps = group.is_opaque(),
                          .stepped = group.stepped,
                          .follows_time = group.turns ? FollowsTime::yes : group.follows_time,
                          .group = static_cast<int>(i),
                          .entry = entry}});
    }
  }
}

void GuardSet::clear() {
  ++version_;
  fired_at_root.clear(), beside_root.clear(), beside_stop.clear(), monitors.clear(), kept_.clear();
  active_.clear();
  for (Guard& guard : guards_) {
    const GuardTraits traits = guard;
    guard = {};
    static_cast<GuardTraits&>(guard) = traits;
  }
}

void GuardSet::select(const std::vector<int>& groups, const Plan& plan) {
  ++version_;
  active_.clear();
  for (const int i : groups) {
    const GuardGroup& group = plan.guards[i];
    for (Index s = group.slot; s < group.slot + group.size; ++s)
      active_.add(static_cast<std::size_t>(s), guards_[s], group.is_crossing());
    active_.add_reads(group);
  }
  for (Guard& guard : guards_) guard.was_active = std::exchange(guard.active, false);
  for (const std::size_t k : active_.all) {
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
    arm(k, firing.from);
    if (k < kept_.size()) guards_[k].base = kept_[k].base;  // the value before the root
  }
}

std::vector<Continuation::Guard> records_of(const GuardSet& guards) {
  std::vector<Continuation::Guard> saved;
  for (const Guard& guard : guards.all())
    saved.push_back(
        {guard.side, guard.came_from, guard.at_zero(), guard.rests, guard.error, guard.base});
  return saved;
}

std::vector<Continuation::Leaving> leaving_of(const GuardSet& guards) {
  std::vector<Continuation::Leaving> saved;
  for (std::size_t k = 0; k < guards.all().size(); ++k) {
    const Guard& guard = guards[k];
    if (std::isnan(guard.clear_at)) continue;
    const bool waited = !std::isnan(guard.armed_at);
    saved.push_back({static_cast<int>(k), waited, waited ? guard.armed_at : 0.0, guard.clear_at});
  }
  return saved;
}

void load_leaving(GuardSet& guards, const std::vector<Continuation::Leaving>& from) {
  for (const Continuation::Leaving& one : from)
    guards.mark_armed_at(static_cast<std::size_t>(one.guard), one.waited ? one.armed_at : not_armed,
                         one.clear_at);
}

void load_records(GuardSet& guards, const std::vector<Continuation::Guard>& from) {
  List<Guard> records = guards.all();
  for (std::size_t k = 0; k < records.size(); ++k) {
    Guard& guard = records[k];
    guard.phase = from[k].at_zero ? Phase::waiting : Phase::unseen;
    guard.error = from[k].error;
    guard.turn(from[k].side);
    guard.came_from = static_cast<signed char>(from[k].from);
    guard.rests = from[k].resting, guard.base = from[k].base;
  }
  guards.restore(records);
}

}  // namespace saltus
