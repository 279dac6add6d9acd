// GuardSet: the records of all guards of a run. The engine arms them, the locator follows them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "saltus/model/continuation.hpp"
#include "saltus/plan/plan.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// The only writer of guard records. What the engine writes counts the version up, so that a
/// locator knows when the values it derived from the records are out of date; what the locator
/// itself writes does not.
class GuardSet {
 public:
  GuardSet() = default;
  explicit GuardSet(const Plan& plan);

  /// One more guard, unseen.
  void add(const GuardTraits& traits, bool active = true);

  std::size_t size() const noexcept { return guards_.size(); }
  const Guard& operator[](std::size_t k) const { return guards_[k]; }
  const std::vector<Guard>& all() const noexcept { return guards_; }
  /// The guards that can fire in the present modes.
  const std::vector<std::size_t>& active() const noexcept { return active_; }
  std::int64_t version() const noexcept { return version_; }

  // --- written by the engine

  /// All guards as they were made: unseen, inactive.
  void clear();
  /// Chooses the guards that can fire now; a guard whose mode was just entered is unseen.
  void select(const std::vector<int>& groups, const Plan& plan);
  /// On `side` without any doubt.
  void arm(std::size_t k, int side) { set(k, Phase::armed, side, 0.0); }
  /// At zero within `error`: fires only after it has been clearly on `side`.
  void wait(std::size_t k, int side, double error) { set(k, Phase::waiting, side, error); }
  /// Its block is at rest; the flow presses it to `side`.
  void rest(std::size_t k, int side, double error) { set(k, Phase::resting, side, error); }
  /// Its block is carried.
  void carry(std::size_t k) { set(k, Phase::carried, -1, 0.0); }
  /// Its block is not at rest any more; what its value counts as does not change.
  void leave_rest(std::size_t k);
  /// Another side; 0 for none. The phase changes with it only where the guard did not wait.
  void turn(std::size_t k, int side) {
    ++version_;
    guards_[k].turn(side);
  }
  /// What counts as zero, the side unchanged.
  void set_error(std::size_t k, double error) { ++version_, guards_[k].error = error; }
  /// The value that edge_detection compares with.
  void set_base(std::size_t k, double value) { ++version_, guards_[k].base = value; }
  /// A look at which it did not fire.
  void see(std::size_t k, double value) {
    ++version_;
    g[k] = value;
    follow(k, value);
  }
  void fired(std::size_t k, int from) { guards_[k].came_from = static_cast<signed char>(from); }
  /// A relation keeps its truth from now on, or does not any more.
  void keep_truth(std::size_t k, bool yes) { guards_[k].rests = yes; }
  /// When it began to wait after a firing; NaN if it did not.
  void mark_armed_at(std::size_t k, double t) { guards_[k].armed_at = t; }

  /// Its share of what a run that goes on has to know: the records.
  std::vector<Continuation::Guard> save() const;
  bool fits(const Continuation& from) const { return from.guards.size() == guards_.size(); }
  void load(const Continuation& from);

  // --- written by the locator

  /// Takes over the side after a look at which it did not fire.
  void follow(std::size_t k, double value) {
    Guard& guard = guards_[k];
    guard.base = value;
    if (guard.phase == Phase::resting) return;
    if (const int now = guard.sign(value); now != 0) guard.settle(now);
  }
  /// A guard that waits has been seen clearly on its side: an ordinary one from there on.
  void leave_zero(std::size_t k) { guards_[k].settle(guards_[k].side); }
  /// A monitor that crossed is at zero on its new side.
  void pass(std::size_t k, int side, double error) {
    Guard& guard = guards_[k];
    guard.side = static_cast<signed char>(side), guard.phase = Phase::waiting, guard.error = error;
  }
  /// The side it leaves to, where that is not known yet; 0: exactly on zero.
  void leave_to(std::size_t k, int side) { guards_[k].turn(side); }

  std::vector<double> g;              ///< values at the last time looked at
  std::vector<Firing> fired_at_root;  ///< the guards that crossed at the last root
  std::vector<MonitorHit> monitors;   ///< crossings of monitors in the last advance
  int scan_points = 3;                ///< interior points of a step at which guards are looked at

 private:
  void set(std::size_t k, Phase phase, int side, double error) {
    ++version_;
    Guard& guard = guards_[k];
    guard.phase = phase, guard.side = static_cast<signed char>(side), guard.error = error;
  }

  std::vector<Guard> guards_;
  std::vector<std::size_t> active_;
  std::int64_t version_ = 0;
};

}  // namespace saltus
