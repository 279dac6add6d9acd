// A ball on a floor as declarations of a leaf, to which a test adds guards of its own.
#pragma once

#include "support/leaves.hpp"

namespace support {

/// x = (height [m], velocity [m/s]), dropped from `height`, with g [m/s^2]; "bounce" at height 0 leaves
/// 0.8 of the velocity.
inline void declare_bouncing(Leaf& l, double height, double g) {
  l.declare_continuous_state({.initial = vec({height, 0.0}),
                              .ode = [g](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
  l.declare_zero_crossing(
      {.name = "bounce",
       .guard = [](const At& at) { return at.x[0]; },
       .reset_map = [](const At& at,
                       Next& next) { next.set_continuous_state({0.0, -0.8 * at.x[1]}); },
       .direction = saltus::Direction::positive_then_non_positive});
}

}  // namespace support
