// Blocks with a continuous state.
#include "blocks.hpp"
#include "saltus/library/integrator.hpp"
#include "saltus/library/second_order_integrator.hpp"
#include "saltus/library/slew_rate_limiter.hpp"

namespace saltus::python {

void bind_state(py::module_& module) {
  using Handle = const py::object&;
  py::class_<Integrator, System>(module, "Integrator")
      .def(py::init([](const std::string& name, Handle initial_state, bool enable_reset,
                       bool enable_external_reset, std::optional<double> zeno_tolerance,
                       bool enable_limits, Handle lower_limit, Handle upper_limit,
                       bool enable_hold) {
        const Arguments of(name);
        return std::make_unique<Integrator>(
            name, IntegratorOptions{.initial_state = of.value(initial_state, "initial_state"),
                                    .enable_reset = enable_reset,
                                    .enable_external_reset = enable_external_reset,
                                    .zeno_tolerance = zeno_tolerance,
                                    .enable_limits = enable_limits,
                                    .lower_limit = of.optional(lower_limit, "lower_limit"),
                                    .upper_limit = of.optional(upper_limit, "upper_limit"),
                                    .enable_hold = enable_hold});
      }));
  py::class_<SecondOrderIntegrator, System>(module, "SecondOrderIntegrator")
      .def(py::init([](const std::string& name, Handle position, Handle velocity,
                       Handle lower_limit, Handle upper_limit, double restitution, Handle slowest,
                       Handle fastest) {
        const Arguments of(name);
        return std::make_unique<SecondOrderIntegrator>(
            name, SecondOrderIntegratorOptions{of.value(position, "initial_position"),
                                               of.value(velocity, "initial_velocity"),
                                               of.optional(lower_limit, "lower_limit"),
                                               of.optional(upper_limit, "upper_limit"), restitution,
                                               of.optional(slowest, "lower_velocity_limit"),
                                               of.optional(fastest, "upper_velocity_limit")});
      }));
  py::class_<SlewRateLimiter, System>(module, "SlewRateLimiter")
      .def(py::init([](const std::string& name, double upper, double lower, double time_constant,
                       Handle initial_state) {
        return std::make_unique<SlewRateLimiter>(
            name, SlewRateLimiterOptions{lower, upper, time_constant,
                                         Arguments(name).value(initial_state, "initial_state")});
      }));
  bind_mechanics(module);
}

}  // namespace saltus::python
