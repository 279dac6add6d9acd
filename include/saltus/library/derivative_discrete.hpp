// y[k] = (u[k] - u[k-1]) / dt, elementwise; or, with a filter of the coefficient N, the derivative
// s N / (s + N) of u by the backward rule: y[k] = N (u[k] - x[k]), x[k] = x[k-1] + dt y[k].
// in, out: the shape of initial_state, which is y before the first tick. Parameter
// "filter_coefficient" [1/s], if given. At the first tick y is 0, because there is no u before it.
#pragma once

#include <optional>

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct DerivativeDiscreteOptions {
  std::optional<double> filter_coefficient = {};  ///< [1/s] > 0
  Value initial_state = 0.0;
};

class DerivativeDiscrete final : public detail::SampledSystem {
 public:
  using Options = DerivativeDiscreteOptions;

  DerivativeDiscrete(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
