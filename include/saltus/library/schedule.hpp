// Counting the ticks of a periodic time event from the time alone.
#pragma once

#include <cmath>
#include <limits>

namespace saltus::detail {

/// Time [s] since `offset`, a few roundings ahead. Times that differ by rounding only are one
/// instant, so an event may be taken a few ulps before its time; without the lead it would be
/// missed there, and nothing looks again.
inline double since(double time, double offset) {
  return time - offset +
         8.0 * std::numeric_limits<double>::epsilon() * (std::abs(time) + std::abs(offset));
}

/// Number k of the last tick at or before `time`; negative before the first, which is tick 0 at
/// `offset`.
inline double last_tick(double time, double period, double offset = 0.0) {
  return std::floor(since(time, offset) / period);
}

}  // namespace saltus::detail
