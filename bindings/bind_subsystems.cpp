// Blocks of enabled and triggered subsystems.
#include "blocks.hpp"
#include "saltus/library/control_port.hpp"
#include "saltus/library/subsystem_output.hpp"

namespace saltus::python {

void bind_subsystems(py::module_& module) {
  py::class_<ControlPort, System>(module, "ControlPort").def(py::init<std::string>());
  py::class_<SubsystemOutput, System>(module, "SubsystemOutput")
      .def(py::init([](const std::string& name, std::string_view kind, bool resets,
                       std::string_view edge, const py::object& initial_output) {
        return std::make_unique<SubsystemOutput>(
            name, SubsystemOutputOptions{
                      .initial_output = Arguments(name).value(initial_output, "initial_output"),
                      .execution = execution_from(name, kind, resets, edge)});
      }));
}

}  // namespace saltus::python
