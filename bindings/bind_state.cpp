// Blocks with a state.
#include "blocks.hpp"
#include "saltus/library/integrator.hpp"
#include "saltus/library/unit_delay.hpp"
#include "saltus/library/zero_order_hold.hpp"

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
  py::class_<UnitDelay, System>(module, "UnitDelay")
      .def(py::init([](const std::string& name, double dt, Handle initial_state) {
        return std::make_unique<UnitDelay>(
            name, dt, UnitDelayOptions{Arguments(name).value(initial_state, "initial_state")});
      }));
  py::class_<ZeroOrderHold, System>(module, "ZeroOrderHold")
      .def(py::init([](const std::string& name, double dt, Handle initial_state) {
        return std::make_unique<ZeroOrderHold>(
            name, dt, ZeroOrderHoldOptions{Arguments(name).value(initial_state, "initial_state")});
      }));
}

}  // namespace saltus::python
