// System, Diagram and DiagramBuilder. The Python object of a block owns the block. The shared
// pointers here own nothing; the Python diagram keeps the objects of its blocks, so the garbage
// collector sees them.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "blocks.hpp"
#include "made.hpp"
#include "numbers.hpp"
#include "python_leaf.hpp"
#include "saltus/model/diagram_builder.hpp"

namespace saltus::python {

namespace {

/// The paths of the blocks whose Python functions a run calls.
std::vector<std::string> interpreted_blocks(const System& system) {
  std::vector<std::string> paths;
  for (const Structure::Leaf& leaf : structure_of(system).leaves) {
    const auto* python = dynamic_cast<const PythonLeaf*>(leaf.system);
    if (python != nullptr && python->needs_interpreter()) paths.push_back(leaf.path);
  }
  return paths;
}

using Entry = std::optional<Index>;  // of an event

}  // namespace

void bind_system(py::module_& module) {
  py::class_<System>(module, "System")
      .def_property_readonly("name", &System::name)
      .def_property_readonly("system_id",
                             [](const System& system) { return system.system_id().value; })
      .def_property_readonly("input_names", &System::input_names)
      .def_property_readonly("output_names", &System::output_names)
      .def_property_readonly("interpreted_blocks", &interpreted_blocks)
      .def("find_input", [](const System& system, int index) { return system.input(index).index; })
      .def("find_input",
           [](const System& system, std::string_view name) { return system.input(name).index; })
      .def("find_output",
           [](const System& system, int index) { return system.output(index).index; })
      .def("find_output",
           [](const System& system, std::string_view name) { return system.output(name).index; })
      .def_property_readonly("event_output_names", &System::event_output_names)
      .def_property_readonly("event_input_names", &System::event_input_names)
      .def("find_event_output",
           [](const System& system, std::string_view name, Entry entry) {
             const EventOutputPort port = system.event_output(name, entry);
             return port.index;
           })
      .def("find_event_input",
           [](const System& system, std::string_view name, Entry entry) {
             const EventInputPort port = system.event_input(name, entry);
             return port.index;
           })
      .def("create_context", &System::create_context);

  py::class_<DiagramBuilder>(module, "DiagramBuilder")
      .def(py::init<>())
      .def("add",
           [](DiagramBuilder& builder, const System& system) {
             builder.add(std::shared_ptr<const System>(std::shared_ptr<void>(), &system));
           })
      .def("connect", [](DiagramBuilder& builder, const System& from, int output, const System& to,
                         int input) { builder.connect({&from, output}, {&to, input}); })
      .def("connect_event",
           [](DiagramBuilder& builder, const System& from, int event, Entry from_entry,
              const System& to, int input, Entry to_entry, double weight, double delay) {
             builder.connect_event({&from, event, from_entry}, {&to, input, to_entry}, weight,
                                   delay);
           })
      .def("export_event_output",
           [](DiagramBuilder& builder, const System& system, int event, Entry entry,
              std::string name) {
             return builder.export_event_output({&system, event, entry}, std::move(name));
           })
      .def("export_event_input",
           [](DiagramBuilder& builder, const System& system, int input, Entry entry,
              std::string name) {
             return builder.export_event_input({&system, input, entry}, std::move(name));
           })
      .def("execute",
           [](DiagramBuilder& builder, const System& block, const System& control, int output,
              std::string_view kind, bool resets, std::string_view edge) {
             builder.execute(block, {&control, output},
                             execution_from(block.name(), kind, resets, edge));
           })
      .def("export_input",
           [](DiagramBuilder& builder, const System& system, int index, std::string name) {
             return builder.export_input({&system, index}, std::move(name));
           })
      .def("export_output",
           [](DiagramBuilder& builder, const System& system, int index, std::string name) {
             return builder.export_output({&system, index}, std::move(name));
           })
      .def("declare_parameter",
           [](DiagramBuilder& builder, std::string name, py::handle value) {
             const Eigen::VectorXd values = to_vector(value, text("parameter '", name, "'"));
             return builder.declare_parameter(std::move(name), values).offset;
           })
      .def("compute_parameter",
           [](DiagramBuilder& builder, const System& block, std::string_view parameter,
              const tape::Tape& values) { builder.compute_parameter(block, parameter, values); });

  py::class_<Diagram, System>(module, "Diagram")
      .def(py::init([](DiagramBuilder& builder, std::string name) {
        const ShapesAsDeclared declared;
        return builder.build(std::move(name));
      }))
      .def("require", [](const Diagram& diagram, std::string_view child) { diagram[child]; });

  module.def("fixes_input",
             [](const System& system, int input) { return system.fixes_input(input); });
  module.def("made", [](const py::handle& system) {
    return py::isinstance<System>(system) && holds_block(system.ptr());
  });

  // The default name of the next system: Gain_7.
  module.def("next_name", [](const std::string& kind) {
    return text(kind, "_", LeafSystem().system_id().value + 1);
  });
}

}  // namespace saltus::python
