// y[k] = (u[k] - u[k-1]) / dt, or the same behind a filter.
#include "saltus/library/derivative_discrete.hpp"

#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

/// s = (x, whether there was a tick). Both forms are y = gain (u - x), x := u - y / N: without a
/// filter N is infinite, the gain 1 / dt.
DerivativeDiscrete::DerivativeDiscrete(std::string name, double dt, const Options& options)
    : SampledSystem(std::move(name)) {
  std::optional<ParameterIndex> coefficient;
  if (options.filter_coefficient) {
    coefficient = declare_dynamic_parameter("filter_coefficient", *options.filter_coefficient);
    declare_parameter_check(detail::positive(*coefficient, "filter_coefficient", " 1/s",
                                             ", or none for the plain difference"));
  }
  const Index n = options.initial_state.values.size();
  declare_input_port({.name = "in", .shape = options.initial_state.shape()});
  const auto gain = [=](const At& at) {
    return coefficient ? at.p[*coefficient] / (1.0 + dt * at.p[*coefficient]) : 1.0 / dt;
  };
  const auto slope = [=](const At& at, const VectorView& s, VectorRef y) {
    if (s[n] == 0.0)
      y.setZero();
    else
      y = gain(at) * (at.u[0] - s.head(n));
  };
  declare_law({.dt = dt,
               .before = options.initial_state,
               .state = Eigen::VectorXd::Zero(n + 1),
               .feedthrough = {0},
               .output = slope,
               .next = [=](const At& at, const VectorView& s, VectorRef next) {
                 slope(at, s, VectorRef(next.data(), n));
                 const double lag = coefficient ? 1.0 / at.p[*coefficient] : 0.0;
                 next.head(n) = at.u[0] - lag * next.head(n);
                 next[n] = 1.0;
               }});
}

}  // namespace saltus
