// Calendar: time events, counted by integers, equal times merged.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <vector>

#include "saltus/plan/plan.hpp"
#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"

namespace saltus {

/// The times of all scheduled events. Tick k of a schedule is at offset + k period, computed from
/// the integer k: 1000 periods of 1/3 s are 1000 ticks. Tick k of a list is its time k.
class Calendar {
 public:
  /// `z`: the discrete state of the run, which the ticks of some events depend on.
  /// `waiting` [s]: the time at which the next execution of a queued zero crossing, or the next
  /// delivery of an event wire, is due; null if the scene has none.
  explicit Calendar(const Plan& plan, const Eigen::VectorXd* z = nullptr,
                    const double* waiting = nullptr)
      : plan_(&plan), z_(z), waiting_(waiting), tick_(plan.schedule.size(), 0) {}

  /// Throws ModelError for a schedule whose ticks at t cannot be told apart.
  void check(double t) const {
    for (std::size_t i = 0; i < tick_.size(); ++i) ticks_before(i, t);
  }

  /// The next tick of each schedule becomes the first tick at or after t. If the instant at t is
  /// settled already, it becomes the first tick after t. Throws as `check` does.
  void begin(double t, bool settled) {
    for (std::size_t i = 0; i < tick_.size(); ++i) {
      const ScheduledEvent& event = plan_->schedule[i];
      if (by_state(event)) continue;  // its discrete state tells which ticks are past
      tick_[i] = event.times.empty()
                     ? std::max<std::int64_t>(0, ticks_before(i, t) - 1)
                     : std::ranges::lower_bound(event.times, t - slack(t)) - event.times.begin();
      // At most four rounds: the number of ticks is right to one, and ticks are apart.
      while (time_of(i) < t - slack(t) || (settled && time_of(i) <= t + slack(t))) ++tick_[i];
    }
  }

  /// [s] The time of the next time event; infinite if there is none. Some ticks are counted, others
  /// follow from a discrete state. Where such ticks differ by rounding only, this is the time of the
  /// counted one, because a discrete state carries the roundings of the instants before it.
  double next() const {
    double counted = infinite, any = infinite;
    for (std::size_t i = 0; i < tick_.size(); ++i) {
      const double t = time_of(i);
      any = std::min(any, t);
      if (!by_state(plan_->schedule[i])) counted = std::min(counted, t);
    }
    if (waiting_ != nullptr) any = std::min(any, *waiting_);
    return counted <= any + slack(any) ? counted : any;
  }

  /// [s] Where a run stops that may not go beyond `latest`: there, or at the next time event, also if
  /// that is later by rounding only.
  double stop(double latest) const {
    const double t = next();
    return t <= latest + slack(latest) ? t : latest;
  }

  /// [s] The time of the next time event if a root at t, which was located before it in a step from `from`,
  /// may be there but for rounding; otherwise t.
  double stop_at_root(double from, double t) const {
    const double event = next();
    const double near = std::max(thresholds::beside_stop * (event - from), resolution(event));
    return std::isfinite(event) && t < event && event - t <= near ? event : t;
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
        require_apart<SimulationError>(i, t);
      }
    }
  }

  /// [s] Times that differ by rounding only are one instant: 3 * 0.1 and 0.3.
  static double slack(double t) {
    return thresholds::tick_roundings * thresholds::eps * std::abs(t);
  }

  /// [s] A crossing that is nearer to a stop at t is there: it is apart by rounding alone.
  static double resolution(double t) {
    return thresholds::stop_roundings * thresholds::eps * std::abs(t);
  }

  /// Whether no instant that begins at t [s] reaches `later` [s].
  static bool is_clearly_before(double t, double later) { return t + 2.0 * slack(t) < later; }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  double time_of(std::size_t i) const {
    const ScheduledEvent& event = plan_->schedule[i];
    if (by_state(event)) return next_of(event);
    if (tick_[i] >= event.ticks) return infinite;
    if (!event.times.empty()) return event.times[tick_[i]];
    if (tick_[i] == 0) return event.offset;
    return std::isfinite(event.period) ? event.offset + static_cast<double>(tick_[i]) * event.period
                                       : infinite;
  }

  bool by_state(const ScheduledEvent& event) const { return z_ != nullptr && event.by_state; }
  double next_of(const ScheduledEvent& event) const {
    const PlanLeaf& leaf = plan_->leaf(event.leaf);
    return plan_->time_event_of(event).next(VectorView(z_->data() + leaf.z, leaf.nz));
  }

  /// The number of ticks before t, right to one; negative before the offset.
  std::int64_t ticks_before(std::size_t i, double t) const {
    const ScheduledEvent& event = plan_->schedule[i];
    if (!std::isfinite(event.period) || t < event.offset) return 0;
    const double ticks = std::floor((t - event.offset) / event.period);
    // Beyond 2^53 a double does not tell tick k from tick k + 1.
    if (!(ticks < 0x1p53)) throw_not_apart<ModelError>(i, t);
    require_apart<ModelError>(i, t);
    return static_cast<std::int64_t>(ticks);
  }

  /// A tick that is within rounding of the next one would be due at once, again and again.
  template <class Kind>
  void require_apart(std::size_t i, double t) const {
    const ScheduledEvent& event = plan_->schedule[i];
    if (event.period <= std::max(slack(t), slack(event.offset))) throw_not_apart<Kind>(i, t);
  }

  template <class Kind>
  [[noreturn]] void throw_not_apart(std::size_t i, double t) const {
    const ScheduledEvent& event = plan_->schedule[i];
    const std::string what = text(
        "t = ", t, " s: the ticks of '", event.name, "', period ", event.period,
        " s from t = ", event.offset,
        " s, cannot be told apart here; expected a period longer than the rounding of the time "
        "and of the offset; choose a longer period, or an offset near the run");
    if constexpr (std::same_as<Kind, SimulationError>)
      throw SimulationError(what, t, plan_->leaf(event.leaf).path);
    else
      throw ModelError(what);
  }

  const Plan* plan_;
  const Eigen::VectorXd* z_;
  const double* waiting_;
  std::vector<std::int64_t> tick_;
};

}  // namespace saltus
