// y = (b_0 z^m + ... + b_m) / (a_0 z^n + ... + a_n) u, with m <= n; z is the shift by one tick.
// in, out: scalar; y is held from tick k, at t = k dt, to the next. Parameters "numerator" (b) and
// "denominator" (a), the highest power first. The input reaches the output at once only if m = n.
#pragma once

#include <optional>

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct TransferFunctionDiscreteOptions {
  /// v[-1], ..., v[-n], where v solves a_0 v[k] + ... + a_n v[k-n] = u[k]; otherwise 0.
  std::optional<Eigen::VectorXd> initial_state = {};
};

class TransferFunctionDiscrete final : public detail::SampledSystem {
 public:
  using Options = TransferFunctionDiscreteOptions;

  TransferFunctionDiscrete(std::string name, double dt, const Eigen::VectorXd& numerator,
                           const Eigen::VectorXd& denominator, const Options& options = {});
};

}  // namespace saltus
