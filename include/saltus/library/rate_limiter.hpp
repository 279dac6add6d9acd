// y[k] = u[k], but at least y[k-1] + dt lower_limit and at most y[k-1] + dt upper_limit;
// elementwise, held from tick k, at t = k dt, to the next tick. The first tick takes u as it is.
// in, out: the shape of initial_state, which is y before the first tick. Parameters "lower_limit",
// "upper_limit" [1/s]. y is a view of the discrete state: a block that samples y at the same tick
// gets the value before it, as with a ZeroOrderHold.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct RateLimiterOptions {
  double lower_limit = -1.0;  ///< [1/s] <= upper_limit
  double upper_limit = 1.0;   ///< [1/s]
  Value initial_state = 0.0;
};

class RateLimiter final : public LeafSystem {
 public:
  using Options = RateLimiterOptions;

  RateLimiter(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
