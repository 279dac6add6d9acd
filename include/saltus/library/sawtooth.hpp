// y = amplitude (t - t_k) / period for t_k <= t < t_k + period, with t_k = phase_delay + k period,
// k = 0, 1, ...; 0 before phase_delay. period = 1 / frequency.
// out: shape of amplitude. Parameter "amplitude". Continuous; the jumps are exact time events, and
// the period is held in between: a solver step that ends at a jump does not see the jump.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct SawtoothOptions {
  Value amplitude = 1.0;
  double frequency = 1.0;    ///< [1/s] > 0; structure, as phase_delay
  double phase_delay = 0.0;  ///< [s] where the first tooth begins
};

class Sawtooth final : public LeafSystem {
 public:
  using Options = SawtoothOptions;

  explicit Sawtooth(std::string name, const Options& options = {});
};

}  // namespace saltus
