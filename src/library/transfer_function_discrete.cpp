// y = (b_0 z^m + ... + b_m) / (a_0 z^n + ... + a_n) u, with m <= n.
#include "saltus/library/transfer_function_discrete.hpp"

#include "saltus/library/detail/realisation.hpp"

namespace saltus {

/// s = (v[k-1], ..., v[k-n]); y[k] = b_0 v[k] + ... with b padded by zeros in front.
TransferFunctionDiscrete::TransferFunctionDiscrete(std::string name, double dt,
                                                   const Eigen::VectorXd& numerator,
                                                   const Eigen::VectorXd& denominator,
                                                   const Options& options)
    : SampledSystem(std::move(name)) {
  const auto p = detail::proper(this->name(), "z", numerator, denominator);
  const Index n = p.order(), padding = p.denominator.size() - p.numerator.size();
  const Eigen::VectorXd initial = options.initial_state.value_or(Eigen::VectorXd::Zero(n));
  detail::insist(initial.size() == n, this->name(), "initial_state has ", initial.size(),
                 " values; expected ", n, ", the degree of the denominator");
  const ParameterIndex b = declare_dynamic_parameter("numerator", p.numerator);
  const ParameterIndex a = declare_dynamic_parameter("denominator", p.denominator);
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  const auto newest = [=](const At& at, const VectorView& s) {  // v[k]
    return (at.u(0) - at.parameter(a).tail(n).dot(s)) / at.parameter(a)[0];
  };
  declare_law({.dt = dt,
               .may_inherit = true,
               .state = initial,
               .feedthrough = padding == 0 ? std::vector{0} : std::vector<int>{},
               .output =
                   [=](const At& at, const VectorView& s, VectorRef y) {
                     const VectorView c = at.parameter(b);
                     const Index older = c.size() - (padding == 0 ? 1 : 0);
                     y[0] = c.tail(older).dot(s.tail(older));
                     if (padding == 0) y[0] += c[0] * newest(at, s);
                   },
               .next = [=](const At& at, const VectorView& s,
                           VectorRef next) { next << newest(at, s), s.head(n - 1); }});
}

}  // namespace saltus
