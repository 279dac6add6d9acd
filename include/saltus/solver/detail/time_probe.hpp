// TimeProbe: when called functions are asked whether they follow the time, and what is known then.
#pragma once

#include <cstdint>

#include "saltus/plan/rate.hpp"

namespace saltus {

/// What the looks of a run say of functions that may follow the time: called functions that do not
/// declare what they read.
struct TimeProbe {
  std::int64_t steps = 0;  ///< that were looked into
  std::int64_t due = 1;    ///< the next of them in which such functions are asked
  bool found = false;

  /// A step is looked into: whether such functions are asked in it. They may be constant at times, so
  /// they are asked in the first step, the fourth, the sixteenth, and so on.
  bool is_due() {
    if (found || ++steps != due) return false;
    due *= 4;
    return true;
  }
  /// Whether some guard follows the time, as far as is known.
  [[gnu::always_inline]] bool follow(FollowsTime known) const {
    return known != FollowsTime::no && (found || known == FollowsTime::yes);
  }
};

}  // namespace saltus
