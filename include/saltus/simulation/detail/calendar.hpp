// Calendar: time events, counted by integers, equal times merged.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "saltus/plan/plan.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// The times of all scheduled events. Tick k of a schedule is at offset + k period, computed from
/// the integer k: 1000 periods of 1/3 s are 1000 ticks. Tick k of a list is its time k.
class Calendar {
 public:
  explicit Calendar(const Plan& plan) : plan_(&plan), tick_(plan.schedule.size(), 0) {}

  /// The next tick of each schedule becomes the first tick at or after t. If the instant at t is
  /// settled already, it becomes the first tick after t.
  void begin(double t, bool settled) {
    for (std::size_t i = 0; i < tick_.size(); ++i) {
      const ScheduledEvent& event = plan_->schedule[i];
      tick_[i] = 0;
      if (!event.times.empty()) {
        tick_[i] = std::ranges::lower_bound(event.times, t - slack(t)) - event.times.begin();
      } else if (std::isfinite(event.period)) {
        tick_[i] = std::max<std::int64_t>(
            0, static_cast<std::int64_t>(std::floor((t - event.offset) / event.period)) - 1);
      }
      while (time_of(i) < t - slack(t) || (settled && time_of(i) <= t + slack(t))) ++tick_[i];
    }
  }

  /// [s] the next time event; infinite if there is none.
  double next() const {
    double t = infinite;
    for (std::size_t i = 0; i < tick_.size(); ++i) t = std::min(t, time_of(i));
    return t;
  }

  /// Whether an event is due at t, within rounding: a run that ends at 0.3 has had the tick at 3 *
  /// 0.1.
  bool due(double t) const { return next() <= t + slack(t); }

  /// Lists the events that are due at t in `due`, and advances their ticks.
  void take(double t, std::vector<int>& due) {
    due.clear();
    for (std::size_t i = 0; i < tick_.size(); ++i) {
      if (time_of(i) <= t + slack(t)) {
        due.push_back(static_cast<int>(i));
        ++tick_[i];
      }
    }
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  /// Times that differ by rounding only are one instant: 3 * 0.1 and 0.3.
  static double slack(double t) {
    return thresholds::tick_roundings * thresholds::eps * std::abs(t);
  }

  double time_of(std::size_t i) const {
    const ScheduledEvent& event = plan_->schedule[i];
    if (tick_[i] >= event.ticks) return infinite;
    if (!event.times.empty()) return event.times[static_cast<std::size_t>(tick_[i])];
    if (tick_[i] == 0) return event.offset;
    return std::isfinite(event.period) ? event.offset + static_cast<double>(tick_[i]) * event.period
                                       : infinite;
  }

  const Plan* plan_;
  std::vector<std::int64_t> tick_;
};

}  // namespace saltus
