// y[k] = sqrt(power / dt) times a normally distributed number, from tick k, at t = k dt, to the
// next: noise that is white for signals that are slow against dt. The integral of y has the
// variance power t.
// out: the shape of power. Parameters "seed", "power" [s times the square of the unit of y]. Held;
// ticks are exact time events. y[k] is a function of the seed and k, as with RandomNumber.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct WhiteNoiseOptions {
  Value power = 1.0;  ///< >= 0, the two-sided density over the frequency in Hz
  double seed = 0.0;  ///< any finite number
};

class WhiteNoise final : public LeafSystem {
 public:
  using Options = WhiteNoiseOptions;

  WhiteNoise(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
