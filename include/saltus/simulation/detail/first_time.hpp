// First time: how far ahead of a point the flow is looked at first, to see where it takes a guard.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "saltus/base/detail/is_defined.hpp"
#include "saltus/simulation/detail/early_looks.hpp"
#include "saltus/simulation/detail/flow_probe.hpp"
#include "saltus/solver/detail/guard.hpp"
#include "saltus/solver/detail/time_probe.hpp"

namespace saltus {

/// The first time is that in which a state that the guard depends on moves by its tolerance: before it, the
/// error of the state may decide the side of the guard. The time has no such error. So the first time of a
/// guard that turns by the time, as sin(50 t) beside a slow state does, is divided by eight until looks
/// show how the guard moves in it, and the time moves the guard one way. The first time of a guard that
/// turns by a state, as sin(50 x) does, is divided until looks show how the guard moves.
class FirstTime : public FlowProbe {
 public:
  /// See FlowProbe::count_from.
  void count_from(Index slot, double zero) {
    for (auto& looks : looks_)
      for (Look& look : looks) look.departure = 0;
    FlowProbe::count_from(slot, zero);
  }

 protected:
  FirstTime(Machine& machine, const SimulatorOptions& options) : FlowProbe(machine, options) {
    if (std::ranges::none_of(machine.plan().guards, may_turn)) return;
    probes_.resize(static_cast<Index>(machine.plan().guards.size()));
    for (auto& looks : looks_)
      for (Look& look : looks) look.values.setOnes(machine.plan().look_slots);
  }

  /// [s] For one guard, from the present departure.
  double first_time(const GuardGroup& group, Index slot) {
    if (first_.departure != departure() || first_.slot != slot)
      first_ = {departure(), slot, find_first_time(group, slot)};
    return first_.d;
  }

  /// The time in which the fastest state that the guard depends on moves by its tolerance. A state
  /// that hardly moves so far within the run is ignored: then the time or another block moves the
  /// guard.
  double time_of_states(const GuardGroup& group) const {
    double d = thresholds::first_look_of_run * longest_;  // for a guard that no state moves
    bool moved = false;
    for (int leaf : group.leaves) {
      const PlanLeaf& of = machine_->plan().leaves[leaf];
      for (Index i = of.x; i < of.x + of.nx; ++i) {
        const double time = (rtol_[i] * std::abs((*x_)[i]) + atol_[i]) / std::abs(f_[i]);
        // An infinite rate has no first time: from zero no look would be a later one.
        if (!(time > 0.0 && time <= thresholds::slow_state_of_run * longest_)) continue;
        d = moved ? std::min(d, time) : time;
        moved = true;
      }
    }
    return std::max(d, resolution());
  }

  double longest_ = 0.0;  // [s] how far ahead any look may be

 private:
  /// Whether the states move along a straight line, or are kept, while the time moves.
  enum class Along { line, time };

  /// The first time of a guard, from one departure.
  struct First {
    std::int64_t departure = 0;
    Index slot = -1;
    double d = 0.0;  // [s]
  };

  /// One of the early looks.
  struct Look {
    std::int64_t departure = 0;
    int group = -1;
    double d = 0.0;  // [s] the time of which it is a part
    Along along = Along::line;
    Eigen::VectorXd values;
  };

  static bool may_turn(const GuardGroup& group) {
    return group.follows_time != FollowsTime::no || group.turns;
  }

  /// [s] Times closer than this may be the same time.
  double resolution() const { return thresholds::time_roundings * eps * std::abs(t_); }

  double find_first_time(const GuardGroup& group, Index slot) {
    double d = time_of_states(group);
    if (!may_turn(group)) return d;
    if (group.turns) d = shown_time(Along::line, d, slot);
    if (!follows_time(group, d, slot)) return d;
    g0(slot);  // an exception at the point itself is one of the run
    double by_time = d;
    detail::is_defined([&] { by_time = shown_time(Along::time, d, slot); });
    return by_time;
  }

  /// Whether the time alone moves a guard. A called one is asked by one look, now and then. It may refuse
  /// the state, which does not belong to the time of the look: then nothing is known.
  bool follows_time(const GuardGroup& group, double d, Index slot) {
    TimeProbe& probe = probes_[group_of(slot)];
    if (group.follows_time == FollowsTime::perhaps && probe.is_due()) {
      constexpr std::size_t last = EarlyLooks::parts.size() - 1;
      const double now = g0(slot);
      double later = now;
      detail::is_defined(
          [&] { later = value(looks_[0][last], EarlyLooks::parts[last], Along::time, d, slot); });
      probe.found = later != now;
    }
    return probe.follow(group.follows_time);
  }

  /// The longest of some times, from d on, that looks within it and within an eighth of it show. It is
  /// d if there is none: values that no time shows are rounding.
  double shown_time(Along along, double d, Index slot) {
    bool shown = false;
    double shorter = d;
    for (int k = 0; k < thresholds::shorter_times; ++k, shorter /= thresholds::look_growth) {
      if (!(shorter >= resolution() && shorter > 0.0)) return d;
      const EarlyLooks looks = looks_within(looks_[k % 2], along, shorter, slot);
      const bool before =
          std::exchange(shown, looks.show() && (along == Along::line || looks.go_one_way()));
      if (before && shown) return thresholds::look_growth * shorter;
    }
    return d;
  }

  using Looks = std::array<Look, EarlyLooks::parts.size()>;

  EarlyLooks looks_within(Looks& looks, Along along, double d, Index slot) {
    EarlyLooks found{.start = g0(slot)};
    for (std::size_t i = 0; i < looks.size(); ++i)
      found.after[i] = value(looks[i], EarlyLooks::parts[i], along, d, slot);
    return found;
  }

  /// The value of one look, after a part of d. It serves all guards of a group that depart together.
  double value(Look& look, double part, Along along, double d, Index slot) {
    const int group = group_of(slot);
    if (look.departure != departure() || look.group != group || look.d != d ||
        look.along != along) {
      ahead_ = *x_;
      if (along == Along::line) ahead_ += part * d * f_;
      FlowProbe::look(t_ + part * d, ahead_, slot, look.values);
      look.departure = departure(), look.group = group, look.d = d, look.along = along;
    }
    return look.values[slot];
  }

  First first_;
  List<TimeProbe> probes_;  // of each group
  Eigen::VectorXd ahead_;
  std::array<Looks, 2> looks_;  // within a time, and within an eighth of it
};

}  // namespace saltus
