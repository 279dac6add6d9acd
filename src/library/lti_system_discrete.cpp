// x[k+1] = A x[k] + B u[k], y[k] = C x[k] + D u[k].
#include "saltus/library/lti_system_discrete.hpp"

namespace saltus {

namespace {

using LTIMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const LTIMatrix> lti_matrix(const At& at, ParameterIndex k, Index columns) {
  return {at.parameter(k).data(), k.size / columns, columns};
}

}  // namespace

LTISystemDiscrete::LTISystemDiscrete(std::string name, double dt, const Matrices& matrices,
                                     const Options& options)
    : SampledSystem(std::move(name)) {
  detail::require_sizes(this->name(), matrices, options);
  const detail::LTIParameters k(matrices,
                                [this](const char* parameter, const Eigen::VectorXd& values) {
                                  return declare_dynamic_parameter(parameter, values);
                                });
  const Index n = matrices.A.rows(), inputs = matrices.B.cols(), outputs = matrices.C.rows();
  declare_input_port({.name = "in", .shape = inputs == 1 ? Shape::scalar() : Shape::of(inputs)});
  const Eigen::VectorXd initial = options.initial_state.value_or(Eigen::VectorXd::Zero(n));
  const Eigen::VectorXd before = matrices.C * initial;
  declare_law({.dt = dt,
               .may_inherit = true,
               .before = outputs == 1 ? Value(before[0]) : Value(before),
               .state = initial,
               .feedthrough = k.d ? std::vector{0} : std::vector<int>{},
               .output =
                   [=](const At& at, const VectorView& s, VectorRef y) {
                     y.noalias() = lti_matrix(at, k.c, n) * s;
                     if (k.d) y.noalias() += lti_matrix(at, *k.d, inputs) * at.u[0];
                   },
               .next =
                   [=](const At& at, const VectorView& s, VectorRef next) {
                     next.noalias() = lti_matrix(at, k.a, n) * s;
                     next.noalias() += lti_matrix(at, k.b, inputs) * at.u[0];
                   }});
}

}  // namespace saltus
