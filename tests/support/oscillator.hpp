// An oscillator, whose solution is a circle in closed form.
#pragma once

#include "support/leaves.hpp"

namespace support {

/// x' = y, y' = -x. From (0, 1), (x, y) is (sin t, cos t); from (1, 0) it is (cos t, -sin t).
/// `reads` is the declaration of the values that the derivative reads.
inline void declare_oscillator(Leaf& leaf, const Eigen::Vector2d& start = {0.0, 1.0},
                               saltus::Reads reads = saltus::Reads::everything) {
  leaf.declare_continuous_state(
      {.initial = start,
       .ode = [](const saltus::At& at, saltus::VectorRef xdot) { xdot << at.x[1], -at.x[0]; },
       .reads = reads});
}

}  // namespace support
