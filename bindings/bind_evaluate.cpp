// The values of a system at a context, without a run; and the values of open inputs.
#include "bindings.hpp"
#include "numbers.hpp"
#include "saltus/simulation/evaluate.hpp"
#include "shared_system.hpp"

namespace saltus::python {

namespace {

/// A number, or a read-only array of one or two dimensions.
py::object shown(const SignalValue& value) {
  if (!value.shape.vector) return py::float_(value.values[0]);
  return read_only_array(dimensions_of(value.shape), value.values.data());
}

void fix_input(System& system, int index, py::handle value) {
  const std::string what =
      text("the value of input '", nth(system.input_names(), system.input(index).index),
           "' of block '", system.name(), "'");
  const auto* shared = dynamic_cast<const SharedSystem*>(&system);
  if (shared != nullptr && shared->is_inner()) {
    throw ModelError(text(what,
                          ": the block is part of a diagram that C++ made, where its inputs "
                          "have their sources; fix an input of the diagram"));
  }
  const Array numbers = to_array(value, what);
  system.fix_input(index, as_vector(numbers), shape_of(dimensions_of(numbers), what));
}

}  // namespace

void bind_evaluate(py::module_& module) {
  module.def("fix_input", &fix_input);
  module.def("free_input", [](System& system, int index) { system.free_input(index); });
  module.def("fixes", &System::fixes);
  module.def("evaluate_time_derivatives",
             [](const System& system, const Context& context, const System& part) {
               const Eigen::VectorXd rates = evaluate_time_derivatives(system, context, part);
               return read_only_array({rates.size()}, rates.data());
             });
  module.def("evaluate_output",
             [](const System& system, const System& block, int port, const Context& context) {
               return shown(evaluate_output(system, {&block, port}, context));
             });
  module.def("evaluate_input",
             [](const System& system, const System& block, int port, const Context& context) {
               return shown(evaluate_input(system, {&block, port}, context));
             });
}

}  // namespace saltus::python
