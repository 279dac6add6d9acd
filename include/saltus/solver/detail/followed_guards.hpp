// FollowedGuards: the records of guards as the locator writes them while it searches a step.
#pragma once

#include <concepts>
#include <cstddef>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// The records of all guards of a run, and what a look at a guard, a root or the passage of a
/// monitor writes to them.
class FollowedGuards {
 public:
  const Guard& operator[](std::integral auto k) const { return guards_[k]; }
  const List<Guard>& all() const noexcept { return guards_; }

  /// Follows a guard that stays where it is.
  void follow_base(std::size_t k, double value) { guards_[k].base = value; }
  /// Follows the side after a look at which the guard did not fire.
  void follow(std::size_t k, double value) {
    Guard& guard = guards_[k];
    guard.base = value;
    if (guard.phase == Phase::resting) return;
    const int now = guard.sign(value);
    if (now != 0 || guard.direction == Direction::edge_detection) guard.settle(now);
  }
  /// An edge that was located; true if the guard fires without end.
  bool edge(std::size_t k, const EdgeSeries::Firing& firing) {
    return guards_[k].edges.is_endless(firing);
  }
  /// A guard that waits was clearly on its side at a look: it becomes armed.
  void leave_zero(std::size_t k) { guards_[k].settle(guards_[k].side); }
  /// A monitor that crossed is at zero on its new side.
  void pass(std::size_t k, int side, double error) { guards_[k].set(Phase::waiting, side, error); }
  /// Sets the side to which a guard leaves zero; 0: it is exactly on zero.
  void leave_to(std::size_t k, int side) { guards_[k].turn(side); }

 protected:
  List<Guard> guards_;
};

}  // namespace saltus
