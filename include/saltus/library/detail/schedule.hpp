// Counts the ticks of a periodic time event from the time alone.
#pragma once

#include <cmath>
#include <limits>

namespace saltus::detail {

/// The time [s] since `offset`, a few roundings ahead. Times that differ by rounding only are one
/// instant, so an event may be handled a few ulps before its time. Without the lead the tick would
/// be missed there, and never counted later.
inline double since(double time, double offset) {
  return time - offset +
         8.0 * std::numeric_limits<double>::epsilon() * (std::abs(time) + std::abs(offset));
}

/// Number k of the last tick at or before `time`. Tick 0 is at `offset`; before it the number is
/// negative.
inline double last_tick(double time, double period, double offset = 0.0) {
  return std::floor(since(time, offset) / period);
}

/// Whether a tick is at `time`, within rounding.
inline bool is_tick(double time, double period, double offset = 0.0) {
  const double k = last_tick(time, period, offset), lead = since(time, offset) - (time - offset);
  return k >= 0.0 && since(time, offset) - k * period <= 2.0 * lead;
}

/// Whether a tick is at `time` that was not executed: `executed` is the number of the last one that
/// was.
inline bool is_due(double time, double executed, double period, double offset = 0.0) {
  return is_tick(time, period, offset) && last_tick(time, period, offset) != executed;
}

}  // namespace saltus::detail
