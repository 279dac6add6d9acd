// Logs the times at which u passes an offset: a monitor, which changes no bit of the trajectory.
// in: scalar. No output: the event "hit" of the block is in the event log. Parameter "offset".
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

struct HitCrossingOptions {
  double offset = 0.0;                            ///< in the unit of u
  Direction direction = Direction::crosses_zero;  ///< of u - offset
};

class HitCrossing final : public LeafSystem {
 public:
  using Options = HitCrossingOptions;

  explicit HitCrossing(std::string name, const Options& options = {});
};

}  // namespace saltus
