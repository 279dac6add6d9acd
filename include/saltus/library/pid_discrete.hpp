// v[k] = kp u[k] + i[k] + kd d[k], y[k] = v[k], or v[k] between the limits; held from tick k, at t
// = k dt, to the next. i[k+1] = i[k] + ki dt u[k]; d[k] = n (u[k] - f[k]), f[k] = f[k-1] + dt d[k]:
// the derivative behind a filter, by the backward rule, which is stable for every n.
// in: the error, scalar. out: scalar; initial_state before the first tick. Parameters "kp", "ki"
// [1/s], "kd" [s], "n" [1/s], and the limits, if given. The first tick has no u before it: d[0] =
// 0. With a limit the integral is clamped: it remains at ticks where v is beyond the limit and ki u
// pushes outward.
#pragma once

#include <optional>

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct PIDDiscreteOptions {
  double kp = 1.0;
  double ki = 0.0;             ///< [1/s]
  double kd = 0.0;             ///< [s]
  double n = 100.0;            ///< [1/s] > 0, of the filter of the derivative
  double initial_state = 0.0;  ///< of the integral i, in the unit of y
  std::optional<double> lower_limit = {};
  std::optional<double> upper_limit = {};
};

class PIDDiscrete final : public detail::SampledSystem {
 public:
  using Options = PIDDiscreteOptions;

  PIDDiscrete(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
