// Chattering: four series of events, each with its bound.
#include "saltus/simulation/detail/chattering.hpp"

#include <cmath>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

void Chattering::begin(double t, const Eigen::VectorXd& x) {
  stuck_ = fluttering_ = {};
  roots_ = idle_ = {0, t};
  at_event_ = x;
}

bool Chattering::idle(const Eigen::VectorXd& x) const {
  for (Eigen::Index i = 0; i < at_event_.size(); ++i) {
    const double tolerance = atol_[i] + rtol_[i] * std::abs(x[i]);
    if (!(std::abs(x[i] - at_event_[i]) <= tolerance)) return false;
  }
  return true;
}

bool Chattering::chatters(const Outcome& outcome, const Seen& seen, bool idle,
                          const Eigen::VectorXd& x) {
  using namespace thresholds;
  stuck_.next(outcome.stuck, seen.t);
  fluttering_.next(outcome.flutters, seen.t);
  if (outcome.chatters) return find({outcome.events, seen.t});
  if (!seen.at_root && !seen.executed) return false;
  if (stuck_.count >= stuck_firings) return find(stuck_);
  if (fluttering_.count >= flutters) return find(fluttering_);
  if (roots_.full(roots_in_rounding, seen.t) &&
      seen.t - roots_.since <= root_rounding * std::abs(seen.t))
    return find(roots_);
  at_event_ = x;
  if (!idle) idle_ = {0, seen.t};
  return idle_.full(idle_roots, seen.t) &&
         seen.t - idle_.since <= idle_share * seen.length_of_run && find(idle_);
}

}  // namespace saltus
