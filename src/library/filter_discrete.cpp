// y[k] = b_0 u[k] + b_1 u[k-1] + ... + b_m u[k-m], elementwise.
#include "saltus/library/filter_discrete.hpp"

namespace saltus {

/// s = (u[k-1], ..., u[k-m]).
FilterDiscrete::FilterDiscrete(std::string name, double dt, const Eigen::VectorXd& b_coefficients,
                               const Options& options)
    : SampledSystem(std::move(name)) {
  detail::require_count(this->name(), "b_coefficients", static_cast<int>(b_coefficients.size()), 1);
  const Index m = b_coefficients.size() - 1, n = options.initial_state.values.size();
  const ParameterIndex b = declare_dynamic_parameter("b_coefficients", b_coefficients);
  declare_input_port({.name = "in", .shape = options.initial_state.shape()});
  Value before = options.initial_state;
  before.values *= b_coefficients.sum();
  declare_law({.dt = dt,
               .may_inherit = true,
               .before = before,
               .state = options.initial_state.values.replicate(m, 1),
               .feedthrough = {0},
               .output =
                   [=](const At& at, const VectorView& s, VectorRef y) {
                     y = at.parameter(b)[0] * at.u[0];
                     for (Index i = 1; i <= m; ++i)
                       y += at.parameter(b)[i] * s.segment((i - 1) * n, n);
                   },
               .next = [=](const At& at, const VectorView& s,
                           VectorRef next) { next << at.u[0], s.head((m - 1) * n); }});
}

}  // namespace saltus
