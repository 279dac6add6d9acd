// dy/dt = min(max((u - y) / time_constant, lower_limit), upper_limit), elementwise: y follows u, but
// no faster than the limits. A rate of u is not needed: y lags u by time_constant times the rate
// where u is slower than the limits.
// in, out: the shape of initial_state; out is a view of the state. Parameters "lower_limit",
// "upper_limit" [1/s], "time_constant" [s], single numbers. The times at which a limit begins and
// ends to act are located, because they reach the derivative of y.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct SlewRateLimiterOptions {
  double lower_limit = -1.0;     ///< [1/s] <= 0
  double upper_limit = 1.0;      ///< [1/s] >= 0
  double time_constant = 0.001;  ///< [s] > 0
  Value initial_state = 0.0;     ///< y at the start
};

class SlewRateLimiter final : public LeafSystem {
 public:
  using Options = SlewRateLimiterOptions;

  explicit SlewRateLimiter(std::string name, const Options& options = {});
};

}  // namespace saltus
