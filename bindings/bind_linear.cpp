// Linear systems: blocks with coefficients.
#include "blocks.hpp"
#include "saltus/library/derivative.hpp"
#include "saltus/library/lti_system.hpp"
#include "saltus/library/pid.hpp"
#include "saltus/library/transfer_function.hpp"

namespace saltus::python {

void bind_linear(py::module_& module) {
  using Handle = const py::object&;
  py::class_<Derivative, System>(module, "Derivative")
      .def(py::init([](const std::string& name, Handle coefficient, Handle initial_state) {
        const Arguments of(name);
        return std::make_unique<Derivative>(
            name, DerivativeOptions{of.value(coefficient, "filter_coefficient"),
                                    of.value(initial_state, "initial_state")});
      }));
  py::class_<LTISystem, System>(module, "LTISystem")
      .def(py::init([](const std::string& name, Handle A, Handle B, Handle C, Handle D,
                       Handle initial_state) {
        const Arguments of(name);
        LTISystemMatrices matrices{of.matrix(A, "A"), of.matrix(B, "B"), of.matrix(C, "C")};
        if (!D.is_none()) matrices.D = of.matrix(D, "D");
        return std::make_unique<LTISystem>(
            name, matrices, LTISystemOptions{of.optional_vector(initial_state, "initial_state")});
      }));
  py::class_<PID, System>(module, "PID")
      .def(py::init([](const std::string& name, double kp, double ki, double kd, double n,
                       double initial_state, std::optional<double> lower_limit,
                       std::optional<double> upper_limit, std::optional<double> band) {
        return std::make_unique<PID>(name, PIDOptions{.kp = kp,
                                                      .ki = ki,
                                                      .kd = kd,
                                                      .n = n,
                                                      .initial_state = initial_state,
                                                      .lower_limit = lower_limit,
                                                      .upper_limit = upper_limit,
                                                      .band = band});
      }));
  py::class_<TransferFunction, System>(module, "TransferFunction")
      .def(py::init([](const std::string& name, Handle numerator, Handle denominator,
                       Handle initial_state, std::optional<double> initial_output) {
        const Arguments of(name);
        return std::make_unique<TransferFunction>(
            name, of.vector(numerator, "num"), of.vector(denominator, "den"),
            TransferFunctionOptions{of.optional_vector(initial_state, "initial_state"),
                                    initial_output});
      }))
      .def_property_readonly("scales", [](const TransferFunction& block) {
        const Eigen::VectorXd& scales = block.scales();
        return read_only_array({scales.size()}, scales.data());
      });
}

}  // namespace saltus::python
