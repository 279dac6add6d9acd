// The values of a system at a context, without a run; and the values of open inputs.
#include "bindings.hpp"
#include "numbers.hpp"
#include "saltus/simulation/evaluate.hpp"

namespace saltus::python {

namespace {

/// A number, or a read-only array.
py::object shown(const SignalValue& value) {
  if (!value.shape.vector) return py::float_(value.values[0]);
  return read_only_array({value.values.size()}, value.values.data());
}

void fix_input(System& system, int index, py::handle value) {
  const Array numbers =
      to_array(value, text("the value of an input of block '", system.name(), "'"));
  if (numbers.ndim() > 1) {
    throw ModelError(text("the value of input '",
                          nth(system.input_names(), system.input(index).index), "' of block '",
                          system.name(), "': expected a number or a vector, found an array of ",
                          numbers.ndim(), " dimensions"));
  }
  if (numbers.ndim() == 0) return system.fix_input(index, *numbers.data());
  system.fix_input(index, Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size()));
}

}  // namespace

void bind_evaluate(py::module_& module) {
  module.def("fix_input", &fix_input);
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
