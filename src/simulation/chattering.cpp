// Chattering: five series of events, each with its bound.
#include "saltus/simulation/detail/chattering.hpp"

#include <cmath>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

void Chattering::begin(double t, const Eigen::VectorXd& x) {
  stuck_ = fluttering_ = {};
  roots_ = idle_ = resting_ = {0, t};
  at_event_ = x;
  moved_.setZero(x.size()), moves_ = false;
}

bool Chattering::idle(const Eigen::VectorXd& x) {
  bool idle = true;
  for (Eigen::Index i = 0; i < at_event_.size(); ++i) {
    const double tolerance = atol_[i] + rtol_[i] * std::abs(x[i]);
    const double move = std::abs(x[i] - at_event_[i]);
    moved_[i] += move;
    idle = idle && move <= tolerance;
    moves_ = moves_ || !(moved_[i] <= tolerance);
  }
  return idle;
}

/// Whether a series of many events is full, in which time advances, but no state with it.
bool Chattering::rests(const Seen& seen) {
  using namespace thresholds;
  if (moves_ || resting_.count >= resting_events) {
    resting_ = {};
    moved_.setZero(), moves_ = false;
  }
  if (resting_.count == 0)
    resting_.since = seen.t;  // the time before the first event does not count
  return resting_.full(resting_events, seen.t) &&
         seen.t - resting_.since <= resting_share * seen.length_of_run;
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
  if (rests(seen)) return find(resting_);
  if (!idle) idle_ = {0, seen.t};
  return idle_.full(idle_roots, seen.t) &&
         seen.t - idle_.since <= idle_share * seen.length_of_run && find(idle_);
}

}  // namespace saltus
