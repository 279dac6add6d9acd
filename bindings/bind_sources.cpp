// Blocks without inputs.
#include "blocks.hpp"
#include "saltus/library/clock.hpp"
#include "saltus/library/constant.hpp"
#include "saltus/library/pulse.hpp"
#include "saltus/library/ramp.hpp"
#include "saltus/library/sine.hpp"
#include "saltus/library/step.hpp"

namespace saltus::python {

void bind_sources(py::module_& module) {
  using Handle = const py::object&;
  py::class_<Clock, System>(module, "Clock").def(py::init<std::string>());
  py::class_<Constant, System>(module, "Constant")
      .def(py::init([](const std::string& name, Handle value) {
        return std::make_unique<Constant>(name, Arguments(name).value(value, "value"));
      }));
  py::class_<Pulse, System>(module, "Pulse")
      .def(py::init([](const std::string& name, Handle amplitude, double period, double pulse_width,
                       double phase_delay) {
        return std::make_unique<Pulse>(
            name, PulseOptions{Arguments(name).value(amplitude, "amplitude"), period, pulse_width,
                               phase_delay});
      }));
  py::class_<Ramp, System>(module, "Ramp")
      .def(py::init(
          [](const std::string& name, Handle start_value, Handle slope, double start_time) {
            const Arguments of(name);
            return std::make_unique<Ramp>(name, RampOptions{of.value(start_value, "start_value"),
                                                            of.value(slope, "slope"), start_time});
          }));
  py::class_<Sine, System>(module, "Sine")
      .def(py::init([](const std::string& name, Handle amplitude, Handle frequency, Handle phase,
                       Handle bias) {
        const Arguments of(name);
        return std::make_unique<Sine>(
            name, SineOptions{of.value(amplitude, "amplitude"), of.value(frequency, "frequency"),
                              of.value(phase, "phase"), of.value(bias, "bias")});
      }));
  py::class_<Step, System>(module, "Step")
      .def(py::init(
          [](const std::string& name, Handle start_value, Handle end_value, double step_time) {
            const Arguments of(name);
            return std::make_unique<Step>(name,
                                          StepOptions{of.value(start_value, "start_value"),
                                                      of.value(end_value, "end_value"), step_time});
          }));
  bind_signals(module);
}

}  // namespace saltus::python
