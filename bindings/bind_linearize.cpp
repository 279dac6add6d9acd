// Linearisations of a system: matrices and names.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "numbers.hpp"
#include "saltus/simulation/check_derivatives.hpp"
#include "saltus/simulation/linearize.hpp"
#include "trace_pass.hpp"

namespace saltus::python {

namespace {

using NamedPort = std::tuple<std::string, const System*, int>;
using NamedValue = std::pair<std::string, py::object>;

/// A read-only array of two dimensions.
py::array matrix(const Eigen::MatrixXd& of) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = of;
  return read_only_array({of.rows(), of.cols()}, rows.data());
}
py::array vector(const Eigen::VectorXd& of) { return read_only_array({of.size()}, of.data()); }

LinearInput input_of(const NamedValue& named) {
  const auto& [name, value] = named;
  if (value.is_none()) return name;
  const std::string what = text("linearize: the value of input '", name, "'");
  const Array numbers = to_array(value, what);
  LinearInput input(name, Eigen::VectorXd(as_vector(numbers)));
  input.shape = shape_of(dimensions_of(numbers), what);
  return input;
}

std::unique_ptr<Linearizer> made(const System& system, const std::vector<NamedValue>& inputs,
                                 const std::vector<NamedPort>& outputs, bool one_sided,
                                 const py::object& callbacks) {
  LinearizeOptions options{.one_sided = one_sided};
  for (const NamedValue& input : inputs) options.inputs.push_back(input_of(input));
  options.outputs.emplace();
  for (const auto& [name, block, index] : outputs)
    options.outputs->push_back({name, {block, index}});
  const std::shared_ptr<TracePass> pass = trace_pass(callbacks);
  options.refinement = pass;
  auto linearizer = std::make_unique<Linearizer>(system, std::move(options));
  if (pass) pass->end();
  return linearizer;
}

}  // namespace

void bind_linearize(py::module_& module) {
  py::class_<Linearization>(module, "Linearization")
      .def_property_readonly("A", [](const Linearization& l) { return matrix(l.A); })
      .def_property_readonly("B", [](const Linearization& l) { return matrix(l.B); })
      .def_property_readonly("C", [](const Linearization& l) { return matrix(l.C); })
      .def_property_readonly("D", [](const Linearization& l) { return matrix(l.D); })
      .def_property_readonly("x", [](const Linearization& l) { return vector(l.x); })
      .def_property_readonly("u", [](const Linearization& l) { return vector(l.u); })
      .def_property_readonly("y", [](const Linearization& l) { return vector(l.y); })
      .def_property_readonly("xdot", [](const Linearization& l) { return vector(l.xdot); })
      .def_readonly("time", &Linearization::time)
      .def_readonly("states", &Linearization::states)
      .def_readonly("inputs", &Linearization::inputs)
      .def_readonly("outputs", &Linearization::outputs)
      .def_readonly("differences", &Linearization::differences)
      .def_property_readonly("frozen",
                             [](const Linearization& l) {
                               py::dict frozen;
                               for (const auto& [name, value] : l.frozen)
                                 frozen[py::str(name)] = value;
                               return frozen;
                             })
      .def_property_readonly("guards",
                             [](const Linearization& l) {
                               std::vector<std::tuple<std::string, double, std::string>> guards;
                               for (const auto& [name, value, direction] : l.guards)
                                 guards.emplace_back(name, value, to_string(direction));
                               return guards;
                             })
      .def("method", &Linearization::method);

  module.def("check_derivatives",
             [](const System& system, const Context& context, double tolerance) {
               std::vector<std::tuple<std::string, std::string, Index, double, double>> all;
               for (const WrongDerivative& one : check_derivatives(system, context, tolerance))
                 all.emplace_back(one.function, one.by, one.row, one.declared, one.difference);
               return all;
             });
  py::class_<Linearizer>(module, "Linearizer").def(py::init(&made)).def("at", &Linearizer::at);
}

}  // namespace saltus::python
