// SeenGuards: the groups of guards that can fire in the present modes, and by the present control
// signals.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "saltus/plan/detail/memory.hpp"

namespace saltus {

/// Whether a group can fire in the present mode of its leaf, and by its control signals.
inline bool is_seen(const GuardGroup& group, const Memory& memory) {
  const std::optional<int> mode = memory.plan().start_mode_of(group);
  return (!mode || *mode == memory.modes[group.leaf]) &&
         std::ranges::all_of(group.controls, [&](int control) { return memory.truth(control); });
}

class SeenGuards {
 public:
  explicit SeenGuards(const Memory& memory) : memory_(&memory) {}

  /// Chooses the groups. Some of them may be computed together, as the plan says.
  void select(bool fuses);
  /// Whether a control signal has changed since then. The modes are known to the caller.
  bool outdated() const;

  /// In the order of the plan.
  const std::vector<int>& groups() const noexcept { return groups_; }
  /// The part of them that is not computed together.
  const std::vector<int>& single() const noexcept { return single_; }
  /// The part of them with which other values are looked at.
  const std::vector<int>& looked() const noexcept { return looked_; }

 private:
  const Memory* memory_;
  std::vector<int> groups_, single_, looked_;
  std::vector<char> controls_;  // the control signals when the groups were chosen
};

}  // namespace saltus
