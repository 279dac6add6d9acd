// y = cos(phi + f0 t + (f1 - f0) t^2 / (2 stop_time)): the frequency grows evenly from f0 at t = 0
// to f1 at stop_time, and remains there afterwards. out: elementwise of f0, f1 and phi. Parameters
// "f0", "f1" [rad/s], "phi" [rad]. Continuous; the end of the growth is an exact time event.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct ChirpOptions {
  Value f0 = 1.0;           ///< [rad/s]
  Value f1 = 10.0;          ///< [rad/s]
  double stop_time = 10.0;  ///< [s] > 0; structure, not a parameter
  Value phi = 0.0;          ///< [rad]
};

class Chirp final : public LeafSystem {
 public:
  using Options = ChirpOptions;

  explicit Chirp(std::string name, const Options& options = {});
};

}  // namespace saltus
