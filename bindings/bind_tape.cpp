// Expression graphs and tapes, for the tracer.
#include <cstdint>
#include <optional>

#include <pybind11/stl.h>

#include "numbers.hpp"
#include "saltus/base/error.hpp"
#include "saltus/tape/jacobian.hpp"
#include "saltus/tape/machine_code.hpp"
#include "saltus/tape/tape.hpp"
#include "tape_compiler.hpp"

namespace saltus::python {

namespace {

using tape::Graph;
using tape::Node;
using tape::Tape;

std::vector<Node> nodes(const std::vector<int>& ids) {
  std::vector<Node> result;
  for (const int id : ids) result.push_back({id});
  return result;
}
std::vector<int> ids(std::span<const Node> nodes) {
  std::vector<int> result;
  for (const Node node : nodes) result.push_back(node.id);
  return result;
}

int apply(Graph& graph, std::string_view operation, const py::args& operands) {
  return graph.apply(tape::known_operation(operation), nodes(operands.cast<std::vector<int>>())).id;
}

/// A variable has numbers in place of operands: ("input", [0, 2]).
py::tuple operation(const Graph& graph, int id) {
  const tape::Expression& e = graph[Node{id}];
  const auto count = static_cast<std::size_t>(tape::operand_count(e.op));
  std::vector<int> operands = ids({e.operands.data(), count});
  if (e.op == tape::Op::input) operands.push_back(e.port);
  if (tape::is_variable(e.op) && e.op != tape::Op::time && e.op != tape::Op::mode &&
      e.op != tape::Op::entry) {
    operands.push_back(static_cast<int>(e.index));
  }
  return py::make_tuple(std::string(tape::name(e.op)), operands);
}

py::array call(const Tape& tape, double time, const py::object& x, const py::object& z, int mode,
               Index entry, const py::object& p, const std::vector<py::object>& u) {
  const Eigen::VectorXd states = to_vector(x, "continuous state");
  const Eigen::VectorXd discrete = to_vector(z, "discrete state");
  const Eigen::VectorXd parameters = to_vector(p, "parameters");
  std::vector<double> values;
  std::vector<Place> places;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const Eigen::VectorXd input = to_vector(u[k], text("input ", k));
    places.push_back({Space::y, static_cast<Index>(values.size()), input.size()});
    values.insert(values.end(), input.begin(), input.end());
  }
  const Bases bases{states.data(), discrete.data(), parameters.data(), values.data()};
  At at{time,
        {states.data(), states.size()},
        {discrete.data(), discrete.size()},
        {parameters.data(), parameters.size()},
        mode,
        Inputs(places.data(), static_cast<int>(places.size()), &bases),
        nullptr};
  at.entry = entry;
  tape.check(at);
  py::array_t<double> result(tape.size());
  tape.evaluate(at, result.mutable_data());
  return result;
}

std::vector<std::string> reads(const Tape& tape) {
  std::vector<std::string> words;
  const auto add = [&](bool reads, const char* word) {
    if (reads) words.emplace_back(word);
  };
  add(has(tape.reads(), Reads::time), "time");
  add(has(tape.reads(), Reads::continuous_state), "continuous_state");
  add(has(tape.reads(), Reads::discrete_state), "discrete_state");
  add(has(tape.reads(), Reads::mode), "mode");
  add(tape.reads_entry(), "entry");
  add(tape.reads_parameter(), "parameters");
  add(has(tape.reads(), Reads::inputs), "inputs");
  return words;
}

py::tuple jacobian(const Tape& tape) {
  const tape::Jacobian result = tape::jacobian(tape);
  std::vector<Index> rows, columns;
  for (const MatrixEntry& entry : result.entries) {
    rows.push_back(entry.row);
    columns.push_back(entry.column);
  }
  return py::make_tuple(rows, columns, result.values);
}

/// Names and addresses of the functions that machine code calls.
py::dict called_functions() {
  py::dict all;
  for (const auto& [name, address] : tape::called_functions())
    all[py::str(std::string(name))] = reinterpret_cast<std::uintptr_t>(address);
  return all;
}

void bind_graph(py::module_& module) {
  py::class_<Graph>(module, "Graph")
      .def(py::init<>())
      .def("constant", [](Graph& g, double value) { return g.constant(value).id; })
      .def("time", [](Graph& g) { return g.time().id; })
      .def("continuous_state", [](Graph& g, Index i) { return g.continuous_state(i).id; })
      .def("discrete_state", [](Graph& g, Index i) { return g.discrete_state(i).id; })
      .def("mode", [](Graph& g) { return g.mode().id; })
      .def("entry", [](Graph& g) { return g.entry().id; })
      .def("parameter", [](Graph& g, Index i) { return g.parameter(i).id; })
      .def("input", [](Graph& g, int k, Index i) { return g.input(k, i).id; })
      .def("apply", &apply)
      .def("value", [](const Graph& g, int id) { return g.value(Node{id}); })
      .def("operation", &operation)
      .def("tape", [](const Graph& g, const std::vector<int>& ids) { return Tape(g, nodes(ids)); })
      .def("__len__", &Graph::size);
}

}  // namespace

void bind_tape(py::module_& module) {
  py::class_<Tape>(module, "Tape")
      .def("__call__", &call)
      .def_property_readonly("size", &Tape::size)
      .def_property_readonly("instruction_count", &Tape::instruction_count)
      .def_property_readonly("reads", &reads)
      .def("reads_input", &Tape::reads_input)
      .def("to_string", &Tape::to_string)
      .def("llvm_module", [](const Tape& t) { return tape::llvm_module(std::span(&t, 1)); })
      .def("compile", [](const Tape& t) { compile_tapes(std::span(&t, 1), {}, true); })
      .def_property_readonly("is_machine_code", &Tape::is_machine_code)
      .def("jacobian", &jacobian);
  module.def("called_functions", &called_functions);
  bind_graph(module);
}

}  // namespace saltus::python
