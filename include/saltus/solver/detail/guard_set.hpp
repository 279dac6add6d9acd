// GuardSet: the records of all guards of a run. The engine arms them, the locator follows them.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/model/continuation.hpp"
#include "saltus/plan/plan.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// Guards that are located together.
struct Watch {
  std::vector<std::size_t> slots;
  std::vector<int> groups;  ///< the groups of these slots, in the order of the plan

  void add(std::size_t slot, int group) {
    slots.push_back(slot);
    if (groups.empty() || groups.back() != group) groups.push_back(group);
  }
  void clear() { slots.clear(), groups.clear(); }
};

/// The only writer of guard records. Each write by the engine increments the version, so that a
/// locator knows when the values derived from the records are outdated. Writes by the locator do
/// not change the version.
class GuardSet {
 public:
  GuardSet() = default;
  explicit GuardSet(const Plan& plan);

  /// Adds an unseen guard.
  void add(const GuardTraits& traits, bool active = true);

  std::size_t size() const noexcept { return guards_.size(); }
  const Guard& operator[](std::integral auto k) const { return guards_[k]; }
  const List<Guard>& all() const noexcept { return guards_; }
  /// The guards that can fire in the present modes.
  const std::vector<std::size_t>& active() const noexcept { return active_; }
  /// The active guards that stop the solver, and the active monitors. They are searched one after
  /// the other, because no monitor may change a bit of a root.
  const Watch& stopping() const noexcept { return stopping_; }
  const Watch& watching() const noexcept { return watching_; }
  std::int64_t version() const noexcept { return version_; }

  // --- written by the engine

  /// Resets all guards: unseen, inactive.
  void clear();
  /// Chooses the guards that can fire now; a guard whose mode was just entered is unseen.
  void select(const std::vector<int>& groups, const Plan& plan);
  /// The guard is armed on `side`, without an error.
  void arm(std::size_t k, int side) { set(k, Phase::armed, side, 0.0); }
  /// The guard waits at zero within `error`: it fires only after it has been clearly on `side`.
  void wait(std::size_t k, int side, double error) { set(k, Phase::waiting, side, error); }
  /// The guard rests with its block; the flow presses it to `side`.
  void rest(std::size_t k, int side, double error) { set(k, Phase::resting, side, error); }
  /// The guard is carried with its block.
  void carry(std::size_t k) { set(k, Phase::carried, -1, 0.0); }
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
  /// Notes a look at which the guard did not fire.
  void see(std::size_t k, double value) {
    ++version_;
    g[k] = value;
    follow(k, value);
  }
  void fired(std::size_t k, int from) { guards_[k].came_from = static_cast<signed char>(from); }
  /// Whether a relation keeps its truth from now on.
  void keep_truth(std::size_t k, bool yes) { guards_[k].rests = yes; }
  /// Sets the time at which the guard began to wait after a firing; NaN for none.
  void mark_armed_at(std::size_t k, double t) { guards_[k].armed_at = t; }

  /// Saves the records, which a continued run needs.
  std::vector<Continuation::Guard> save() const;
  bool fits(const Continuation& from) const { return from.guards.size() == guards_.size(); }
  void load(const Continuation& from);

  /// A step is searched: `keep` remembers the records once before they are written, `restore`
  /// undoes what was written since.
  void begin_search() {
    keeps_ = false;
    fired_at_root.clear(), beside_root.clear();
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

  // --- written by the locator

  /// Follows the side after a look at which the guard did not fire.
  void follow(std::size_t k, double value) {
    Guard& guard = guards_[k];
    guard.base = value;
    if (guard.phase == Phase::resting) return;
    const int now = guard.sign(value);
    if (now != 0 || guard.direction == Direction::edge_detection) guard.settle(now);
  }
  /// A guard that waits was clearly on its side at a look: it becomes armed.
  void leave_zero(std::size_t k) { guards_[k].settle(guards_[k].side); }
  /// A monitor that crossed is at zero on its new side.
  void pass(std::size_t k, int side, double error) {
    Guard& guard = guards_[k];
    guard.side = static_cast<signed char>(side), guard.phase = Phase::waiting, guard.error = error;
  }
  /// Sets the side to which a guard leaves zero; 0: it is exactly on zero.
  void leave_to(std::size_t k, int side) { guards_[k].turn(side); }

  List<double> g;                        ///< values at the last look
  std::vector<Firing> fired_at_root;     ///< the guards that crossed at the last root
  std::vector<std::size_t> beside_root;  ///< others within the resolution of that root from zero
  std::vector<MonitorHit> monitors;      ///< crossings of monitors in the last advance
  /// Interior points of a step with a look at the guards; empty: by the degree of the interpolant.
  std::optional<int> scan_points = {};

 private:
  void set(std::size_t k, Phase phase, int side, double error) {
    ++version_;
    Guard& guard = guards_[k];
    guard.phase = phase, guard.side = static_cast<signed char>(side), guard.error = error;
  }

  void watch(Index slot) {
    const auto k = static_cast<std::size_t>(slot);
    active_.push_back(k);
    (guards_[k].monitor ? watching_ : stopping_).add(k, guards_[k].group);
  }

  List<Guard> guards_, kept_;
  bool keeps_ = false;  // kept_ is of the present search
  std::vector<std::size_t> active_;
  Watch stopping_, watching_;
  std::int64_t version_ = 0;
};

}  // namespace saltus
