// Linear systems that change at ticks.
#include "blocks.hpp"
#include "saltus/library/derivative_discrete.hpp"
#include "saltus/library/filter_discrete.hpp"
#include "saltus/library/integrator_discrete.hpp"
#include "saltus/library/lti_system_discrete.hpp"
#include "saltus/library/pid_discrete.hpp"
#include "saltus/library/transfer_function_discrete.hpp"

namespace saltus::python {

namespace {

using Numbers = const py::object&;  // a number, a list or an array

void bind_integrator_discrete(py::module_& module) {
  py::class_<IntegratorDiscrete, System>(module, "IntegratorDiscrete")
      .def(py::init([](const std::string& name, double dt, Numbers initial_state,
                       std::string_view method, bool enable_reset, bool enable_external_reset,
                       bool enable_limits, Numbers lower_limit, Numbers upper_limit,
                       bool enable_hold) {
        const Arguments of(name);
        return std::make_unique<IntegratorDiscrete>(
            name, dt,
            IntegratorDiscreteOptions{.initial_state = of.value(initial_state, "initial_state"),
                                      .method = method,
                                      .enable_reset = enable_reset,
                                      .enable_external_reset = enable_external_reset,
                                      .enable_limits = enable_limits,
                                      .lower_limit = of.optional(lower_limit, "lower_limit"),
                                      .upper_limit = of.optional(upper_limit, "upper_limit"),
                                      .enable_hold = enable_hold});
      }));
}

void bind_pid_discrete(py::module_& module) {
  py::class_<PIDDiscrete, System>(module, "PIDDiscrete")
      .def(py::init([](const std::string& name, double dt, double kp, double ki, double kd,
                       double n, double initial_state, std::optional<double> lower_limit,
                       std::optional<double> upper_limit) {
        return std::make_unique<PIDDiscrete>(name, dt,
                                             PIDDiscreteOptions{.kp = kp,
                                                                .ki = ki,
                                                                .kd = kd,
                                                                .n = n,
                                                                .initial_state = initial_state,
                                                                .lower_limit = lower_limit,
                                                                .upper_limit = upper_limit});
      }));
}

}  // namespace

void bind_discrete_linear(py::module_& module) {
  py::class_<DerivativeDiscrete, System>(module, "DerivativeDiscrete")
      .def(py::init([](const std::string& name, double dt, std::optional<double> coefficient,
                       Numbers initial_state) {
        return std::make_unique<DerivativeDiscrete>(
            name, dt,
            DerivativeDiscreteOptions{coefficient,
                                      Arguments(name).value(initial_state, "initial_state")});
      }));
  py::class_<FilterDiscrete, System>(module, "FilterDiscrete")
      .def(py::init(
          [](const std::string& name, double dt, Numbers coefficients, Numbers initial_state) {
            const Arguments of(name);
            return std::make_unique<FilterDiscrete>(
                name, dt, of.vector(coefficients, "b_coefficients"),
                FilterDiscreteOptions{of.value(initial_state, "initial_state")});
          }));
  bind_integrator_discrete(module);
  py::class_<LTISystemDiscrete, System>(module, "LTISystemDiscrete")
      .def(py::init([](const std::string& name, double dt, Numbers A, Numbers B, Numbers C,
                       Numbers D, Numbers initial_state) {
        const Arguments of(name);
        LTISystemMatrices matrices{of.matrix(A, "A"), of.matrix(B, "B"), of.matrix(C, "C")};
        if (!D.is_none()) matrices.D = of.matrix(D, "D");
        return std::make_unique<LTISystemDiscrete>(
            name, dt, matrices,
            LTISystemOptions{of.optional_vector(initial_state, "initial_state")});
      }));
  bind_pid_discrete(module);
  py::class_<TransferFunctionDiscrete, System>(module, "TransferFunctionDiscrete")
      .def(py::init([](const std::string& name, double dt, Numbers numerator, Numbers denominator,
                       Numbers initial_state) {
        const Arguments of(name);
        return std::make_unique<TransferFunctionDiscrete>(
            name, dt, of.vector(numerator, "num"), of.vector(denominator, "den"),
            TransferFunctionDiscreteOptions{of.optional_vector(initial_state, "initial_state")});
      }));
}

}  // namespace saltus::python
