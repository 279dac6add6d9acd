// y = (b_0 s^m + ... + b_m) / (a_0 s^n + ... + a_n) u, with m <= n.
// in, out: scalar. Parameters "numerator" (b) and "denominator" (a), the highest power first. The
// input reaches the output at once only if m = n.
// The states are those of the controllable companion form, z_k' = z_(k+1), each divided
// by a power of two that balances the system: the states of the context times `scales()` are z.
#pragma once

#include <optional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

/// At most one of the two; without either the state is 0.
struct TransferFunctionOptions {
  /// z at the start: n numbers. z_k is the k-th derivative of the solution v of denominator(s) v =
  /// a_0 u.
  std::optional<Eigen::VectorXd> initial_state = {};
  /// y at the start in a steady state, whose input is y divided by the gain at s = 0.
  std::optional<double> initial_output = {};
};

class TransferFunction final : public LeafSystem {
 public:
  using Options = TransferFunctionOptions;

  TransferFunction(std::string name, const Eigen::VectorXd& numerator,
                   const Eigen::VectorXd& denominator, const Options& options = {});

  /// z = scales * x, entry by entry.
  const Eigen::VectorXd& scales() const noexcept { return scales_; }

 private:
  Eigen::VectorXd scales_;
};

}  // namespace saltus
