// y[k] = b_0 u[k] + b_1 u[k-1] + ... + b_m u[k-m], elementwise: a filter with a finite response.
// in, out: the shape of initial_state, which is u before the first tick: y is
// then initial_state times the sum of the coefficients. Parameter "b_coefficients".
#pragma once

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct FilterDiscreteOptions {
  Value initial_state = 0.0;
};

class FilterDiscrete final : public detail::SampledSystem {
 public:
  using Options = FilterDiscreteOptions;

  FilterDiscrete(std::string name, double dt, const Eigen::VectorXd& b_coefficients,
                 const Options& options = {});
};

}  // namespace saltus
