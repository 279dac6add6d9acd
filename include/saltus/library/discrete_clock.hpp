// y = k dt [s], from tick k to the next tick, k = 0, 1, ...; 0 before the first tick.
// out: scalar. Held; ticks are exact time events.
#pragma once

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

class DiscreteClock final : public detail::SampledSystem {
 public:
  DiscreteClock(std::string name, double dt);
};

}  // namespace saltus
