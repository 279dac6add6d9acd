// What the tests of queued zero crossings share.
#pragma once

#include "support/leaves.hpp"

namespace support {

inline double beyond_one(const At& at) { return at.x[0] - 1.0; }

/// x' = 1 from 0, z = 0, and a plain zero crossing at x = 1, which is declared before any other.
inline void declare_plain(Leaf& leaf, saltus::ResetMap reset_map) {
  declare_ramp(leaf);
  leaf.declare_discrete_state(vec({0.0}));
  leaf.declare_zero_crossing({.name = "plain",
                              .guard = beyond_one,
                              .reset_map = std::move(reset_map),
                              .direction = saltus::Direction::negative_then_non_negative});
}

}  // namespace support
