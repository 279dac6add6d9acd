// Blocks that decide.
#include "blocks.hpp"
#include "saltus/library/comparator.hpp"
#include "saltus/library/logical_operator.hpp"
#include "saltus/library/switch.hpp"

namespace saltus::python {

void bind_logic(py::module_& module) {
  py::class_<Comparator, System>(module, "Comparator")
      .def(py::init<std::string, std::string_view>());
  py::class_<LogicalOperator, System>(module, "LogicalOperator")
      .def(py::init<std::string, std::string, int>());
  py::class_<Switch, System>(module, "Switch")
      .def(py::init([](std::string name, std::optional<double> threshold) {
        return std::make_unique<Switch>(std::move(name), SwitchOptions{threshold});
      }));
}

}  // namespace saltus::python
