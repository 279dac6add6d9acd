// Blocks that decide.
#include "blocks.hpp"
#include "saltus/library/comparator.hpp"
#include "saltus/library/counter.hpp"
#include "saltus/library/detail/words.hpp"
#include "saltus/library/hit_crossing.hpp"
#include "saltus/library/if_then_else.hpp"
#include "saltus/library/logical_operator.hpp"
#include "saltus/library/multiport_switch.hpp"
#include "saltus/library/relay.hpp"
#include "saltus/library/stop.hpp"
#include "saltus/library/switch.hpp"

namespace saltus::python {

void bind_logic(py::module_& module) {
  py::class_<Comparator, System>(module, "Comparator")
      .def(py::init<std::string, std::string_view>());
  py::class_<Counter, System>(module, "Counter")
      .def(py::init(
          [](std::string name, std::string_view edge, std::optional<int> limit, int initial_state) {
            const Edge which = edge_from(name, edge);
            return std::make_unique<Counter>(std::move(name),
                                             CounterOptions{which, limit, initial_state});
          }));
  py::class_<HitCrossing, System>(module, "HitCrossing")
      .def(py::init([](std::string name, double offset, std::string_view direction) {
        return std::make_unique<HitCrossing>(std::move(name),
                                             HitCrossingOptions{offset, direction_from(direction)});
      }));
  py::class_<IfThenElse, System>(module, "IfThenElse").def(py::init<std::string>());
  py::class_<LogicalOperator, System>(module, "LogicalOperator")
      .def(py::init<std::string, std::string, int>());
  py::class_<MultiportSwitch, System>(module, "MultiportSwitch").def(py::init<std::string, int>());
  py::class_<Relay, System>(module, "Relay")
      .def(py::init([](std::string name, double on_threshold, double off_threshold, double on_value,
                       double off_value, bool initially_on) {
        return std::make_unique<Relay>(
            std::move(name),
            RelayOptions{on_threshold, off_threshold, on_value, off_value, initially_on});
      }));
  py::class_<Stop, System>(module, "Stop").def(py::init<std::string>());
  py::class_<Switch, System>(module, "Switch")
      .def(py::init([](std::string name, std::optional<double> threshold) {
        return std::make_unique<Switch>(std::move(name), SwitchOptions{threshold});
      }));
  bind_subsystems(module);
}

}  // namespace saltus::python
