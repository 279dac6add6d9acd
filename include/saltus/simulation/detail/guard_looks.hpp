// Guard looks: the guards at any time and state, a group at a time.
#pragma once

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/machine.hpp"

namespace saltus {

/// Evaluates the group of one guard. All guards would cost n squared where n of them are asked for.
/// The values of one guard may count from a zero of their own.
class GuardLooks {
 public:
  explicit GuardLooks(Machine& machine) : machine_(&machine) {
    const auto& groups = machine.plan().guards;
    for (std::size_t i = 0; i < groups.size(); ++i)
      for (Index k = 0; k < groups[i].size; ++k) group_of_.push_back(static_cast<int>(i));
  }

  /// The group of a guard.
  int group(Index slot) const { return group_of_[slot]; }

  /// From now on the values of one guard count from `zero`, in place of its own zero; -1: of none.
  void count_from(Index slot, double zero) { shifted_ = slot, zero_ = zero; }
  /// The guard whose values do; -1: none.
  Index shifted() const noexcept { return shifted_; }

  /// Sets the guards of the group of `slot` to their values at (t, x).
  void look(double t, const Eigen::VectorXd& x, Index slot, Eigen::VectorXd& g) {
    machine_->guards_of({&group_of_[slot], 1}, t, x.data(), g.data());
    if (shifted_ >= 0 && group_of_[shifted_] == group_of_[slot]) g[shifted_] -= zero_;
  }

 private:
  Machine* machine_;
  List<int> group_of_;  // of each slot
  Index shifted_ = -1;
  double zero_ = 0.0;
};

}  // namespace saltus
