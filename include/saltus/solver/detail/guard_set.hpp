// GuardSet: the records of all guards of a run. The engine arms them, the locator follows them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/model/continuation.hpp"
#include "saltus/plan/plan.hpp"
#include "saltus/solver/detail/followed_guards.hpp"

namespace saltus {

/// A value that some guards read, and the first and the last of these guards.
struct LookedRead {
  std::size_t slot, first_guard, last_guard;
};

/// Guards that are located together.
struct LocatedGuards {
  std::vector<std::size_t> slots;
  std::vector<int> groups;          ///< the groups of these slots, in the order of the plan
  std::vector<LookedRead> reads;    ///< what may vary while some of them are constant
  std::vector<std::size_t> looked;  ///< the slots of these guards and of what they read
  FollowsTime follow_time =
      FollowsTime::no;  ///< what is known of the guard that does so most surely

  void add(std::size_t slot, const GuardTraits& guard) {
    slots.push_back(slot), looked.push_back(slot);
    if (groups.empty() || groups.back() != guard.group) groups.push_back(guard.group);
    follow_time = std::max(follow_time, guard.follows_time);
  }
  void add_reads(const GuardGroup& group) {
    const auto first = static_cast<std::size_t>(group.slot);
    for (const ReadSlot& read : group.reads) {
      const auto slot = static_cast<std::size_t>(read.slot);
      reads.push_back({slot, first, first + static_cast<std::size_t>(group.size) - 1});
      looked.push_back(slot);
    }
  }
  void clear() {
    slots.clear(), groups.clear(), reads.clear(), looked.clear();
    follow_time = FollowsTime::no;
  }
};

/// The guards that can fire in the present modes: all, the guards that stop the solver, and the
/// monitors. The last two are searched one after the other, because no monitor may change a bit of
/// a root.
struct ActiveGuards {
  std::vector<std::size_t> all;  ///< those of zero crossings first
  std::size_t crossing_count = 0;
  LocatedGuards stopping, monitors;

  using Slots = std::span<const std::size_t>;
  Slots crossings() const { return Slots(all).first(crossing_count); }
  Slots relations() const { return Slots(all).subspan(crossing_count); }

  void add(std::size_t slot, const GuardTraits& guard, bool crossing = true) {
    all.push_back(slot), crossing_count += crossing;
    (guard.monitor ? monitors : stopping).add(slot, guard);
  }
  void add_reads(const GuardGroup& group) {
    (group.monitor ? monitors : stopping).add_reads(group);
  }
  void clear() { all.clear(), crossing_count = 0, stopping.clear(), monitors.clear(); }
};

/// The only writer of guard records. Each write by the engine increments the version, so that a
/// locator knows when the values derived from the records are outdated. Writes by the locator,
/// those of FollowedGuards, do not change the version.
class GuardSet : public FollowedGuards {
 public:
  /// Guards that are unseen and active.
  GuardSet(std::initializer_list<GuardTraits> guards = {});
  /// The guards of a plan, unseen and inactive.
  explicit GuardSet(const Plan& plan);

  const ActiveGuards& active() const noexcept { return active_; }
  std::int64_t version() const noexcept { return version_; }

  /// Resets all guards: unseen, inactive.
  void clear();
  /// Chooses the guards that can fire now; a guard whose mode was just entered is unseen.
  void select(const std::vector<int>& groups, const Plan& plan);
  /// The guard is armed on `side`, without an error.
  void arm(std::size_t k, int side) { ++version_, guards_[k].set(Phase::armed, side, 0.0); }
  /// The guard waits at zero within `error`: it fires only after it has been clearly on `side`.
  void wait(std::size_t k, int side, double error) {
    ++version_, guards_[k].set(Phase::waiting, side, error);
  }
  /// The guard rests with its block; the flow presses it to `side`.
  void rest(std::size_t k, int side, double error) {
    ++version_, guards_[k].set(Phase::resting, side, error);
  }
  /// The guard is carried with its block.
  void carry(std::size_t k) { ++version_, guards_[k].set(Phase::carried, -1, 0.0); }
  /// Its block is not at rest any more; side and error do not change.
  void leave_rest(std::size_t k);
  /// Sets the side; 0 for none. The phase changes only if the guard did not wait.
  void turn(std::size_t k, int side) {
    ++version_;
    guards_[k].turn(side);
  }
  /// Sets the error; the side does not change.
  void set_error(std::size_t k, double error) { ++version_, guards_[k].error = error; }
  /// Sets the value that edge_detection compares with.
  void set_base(std::size_t k, double value) { ++version_, guards_[k].base = value; }
  /// The value that edge_detection compared with before the last root.
  double base_before_root(std::size_t k) const {
    return k < kept_.size() ? kept_[k].base : guards_[k].base;
  }
  /// Notes a look at which the guard did not fire.
  void see(std::size_t k, double value) {
    ++version_;
    g[k] = value;
    follow(k, value);
  }
  /// Notes the values that guards read.
  void see_reads(const std::vector<double>& values) {
    for (const LocatedGuards* located : {&active_.stopping, &active_.monitors})
      for (const LookedRead& read : located->reads) g[read.slot] = values[read.slot];
  }
  /// Notes the last value of a guard, with which edge_detection compares the next one.
  void stay(std::size_t k, double value) {
    ++version_;
    g[k] = guards_[k].base = value;
  }
  void fired(std::size_t k, int from) { guards_[k].came_from = static_cast<signed char>(from); }
  /// Whether a relation keeps its truth from now on.
  void keep_truth(std::size_t k, bool yes) { guards_[k].rests = yes; }
  /// Sets the time at which the guard began to wait after a firing, and the time at which the flow has taken it
  /// clearly off zero; NaN for none.
  void mark_armed_at(std::size_t k, double t, double clear_at) {
    guards_[k].armed_at = t, guards_[k].clear_at = clear_at, guards_[k].doubted = 0.0;
  }
  /// A root was false: the guard waits at zero within `error` for `side`.
  void doubt(std::size_t k, int side, double error) {
    wait(k, side, error);
    guards_[k].doubted = error;
  }

  /// A step is searched: `keep` remembers the records once before they are written, `restore`
  /// undoes what was written since.
  void begin_search() {
    keeps_ = false;
    fired_at_root.clear(), beside_root.clear(), beside_stop.clear();
  }
  void keep() {
    if (!keeps_) kept_ = guards_;
    keeps_ = true;
  }
  void restore() {
    fired_at_root.clear();
    if (keeps_) restore(kept_);
  }
  /// Sets all records to those of an earlier copy.
  void restore(const List<Guard>& records) { ++version_, guards_ = records; }
  /// Arms guards that fired at the last root again on the sides they came from, so that they fire
  /// at their present values.
  void arm_again(const std::vector<Firing>& fired);

  List<double> g;                        ///< values at the last look
  std::vector<Firing> fired_at_root;     ///< the guards that crossed at the last root
  std::vector<std::size_t> beside_root;  ///< others within the resolution of that root from zero
  std::vector<std::size_t> beside_stop;  ///< those that may be at zero where a step ends at a stop
  std::vector<MonitorHit> monitors;      ///< crossings of monitors in the last advance
  /// Interior points of a step with a look at the guards; empty: by the degree of the interpolant.
  std::optional<int> scan_points = {};

 private:
  List<Guard> kept_;
  bool keeps_ = false;  // kept_ is of the present search
  ActiveGuards active_;
  std::int64_t version_ = 0;
};

// The part of a continuation that a run needs to continue with the same records.
std::vector<Continuation::Guard> records_of(const GuardSet& guards);
void load_records(GuardSet& guards, const std::vector<Continuation::Guard>& from);
std::vector<Continuation::Leaving> leaving_of(const GuardSet& guards);
void load_leaving(GuardSet& guards, const std::vector<Continuation::Leaving>& from);

}  // namespace saltus
