#include "saltus/plan/detail/seen_guards.hpp"

namespace saltus {

void SeenGuards::select(bool fuses) {
  const Plan& plan = memory_->plan();
  controls_.clear(), groups_.clear(), single_.clear(), looked_.clear();
  for (const int control : plan.controls) controls_.push_back(memory_->truth(control));
  for (std::size_t i = 0; i < plan.guards.size(); ++i) {
    if (!is_seen(plan.guards[i], *memory_)) continue;
    groups_.push_back(static_cast<int>(i));
    if (!fuses || !plan.walks.guards.fused[i]) single_.push_back(static_cast<int>(i));
    if (!plan.guards[i].reads.empty()) looked_.push_back(static_cast<int>(i));
  }
}

bool SeenGuards::outdated() const {
  const Plan& plan = memory_->plan();
  for (std::size_t i = 0; i < plan.controls.size(); ++i)
    if (memory_->truth(plan.controls[i]) != (controls_[i] != 0)) return true;
  return false;
}

}  // namespace saltus
