// The functions with which python/saltus/callbacks/ makes traces.
#include <array>
#include <atomic>

#include <pybind11/stl.h>

#include "bind_traces.hpp"
#include "bindings.hpp"
#include "saltus/base/list.hpp"
#include "saltus/plan/compile.hpp"
#include "trace_pass.hpp"

namespace saltus::python {

namespace {

using tape::Tape;

constexpr std::array roles{"ode",       "jacobian",    "sparse_jacobian", "output",     "guard",
                           "reset_map", "update",      "relation",        "edge_reset", "delay",
                           "priority",  "derivatives", "event_input"};

py::tuple as_tuple(const Dimensions& dimensions) { return py::tuple(py::cast(dimensions)); }

/// Whether the shapes of the outputs are known, as they are once a plan was made.
bool knows_outputs(const BlockTraces& block) {
  return block.outputs.size() == block.leaf->declarations().outputs.size();
}

/// The number of numbers that a function returns; None for a state, and for an output that is not known.
py::object result_size(const BlockTraces& block, const Function& function) {
  const Declarations& d = block.leaf->declarations();
  const auto place = static_cast<std::size_t>(function.index);
  const Index n = d.continuous.initial.size();
  switch (function.role) {
    case Role::ode:
      return py::int_(n);
    case Role::jacobian:
      return py::int_(n * n);
    case Role::sparse_jacobian:
      return py::int_(d.continuous.sparsity->size());
    case Role::output:
      return knows_outputs(block) ? py::object(py::int_(block.outputs[place].size)) : py::none();
    case Role::guard:
      return py::int_(d.zero_crossings[place].size);
    case Role::delay:
    case Role::priority:
      return py::int_(1);
    case Role::relation:
      return py::int_(*d.relations[place].size);
    default:
      return py::none();
  }
}

/// The rows and columns of a rate or an output that is a matrix; otherwise None.
py::object result_shape(const BlockTraces& block, const Function& function) {
  const Dimensions& state = block.leaf->state_dimensions();
  if (function.role == Role::ode && state.size() == 2) return as_tuple(state);
  if (function.role != Role::output || !knows_outputs(block)) return py::none();
  const Shape& shape = nth(block.outputs, function.index);
  return shape.is_matrix() ? py::object(as_tuple(dimensions_of(shape))) : py::object(py::none());
}

/// The inputs that a function gets. The weight of an event wire comes after all inputs of the block.
InputList inputs_of(const BlockTraces& block, const Function& function) {
  InputList inputs = function.inputs;
  if (inputs && gets_weight(function.role))
    inputs->push_back(count_of(block.leaf->declarations().inputs));
  return inputs;
}

py::dict function_of(const BlockTraces& block, int k) {
  const Function& function = block.leaf->function(k);
  py::dict all;
  all["number"] = k;
  all["function"] = function.callable;
  all["method"] = function.method;
  all["convention"] = function.convention;
  all["inputs"] = inputs_of(block, function);
  all["what"] = function.what;
  all["role"] = nth(roles, function.role);
  all["out"] = block.leaf->in_place(function);
  all["compiled"] = function.compiled != nullptr;
  all["result_size"] = result_size(block, function);
  all["result_shape"] = result_shape(block, function);
  return all;
}

py::dict parameters_of(const PythonLeaf& leaf) {
  py::dict parameters;
  const Declarations& d = leaf.declarations();
  const double* value = d.parameter_values.data();
  for (std::size_t i = 0; i < d.parameters.size(); ++i) {
    const py::array array = read_only_array(leaf.parameter_dimensions()[i], value);
    value += array.size();
    parameters[py::str(d.parameters[i].name)] = array;
  }
  return parameters;
}

Trace make_trace(int function, const Tape& tape, const py::object& relations, bool wrote_x,
                 bool wrote_z, bool wrote_mode, bool with_jacobian) {
  static std::atomic<int> serial{0};
  Trace trace{++serial, function, tape, std::nullopt, wrote_x, wrote_z, wrote_mode, std::nullopt};
  if (!relations.is_none()) {
    trace.relations = {relations.attr("differences").cast<Tape>(),
                       relations.attr("true_at_zero").cast<std::vector<bool>>(),
                       relations.attr("truth").cast<Tape>()};
  }
  if (with_jacobian) trace.jacobian = tape::jacobian(tape);
  return trace;
}

/// Traces the blocks of a system to find their shapes. Throws the errors of compile().
void trace(const System& system, const py::object& callbacks) {
  compile(system, {}, trace_pass(callbacks).get());
}

py::list facts_of_all(Traces& traces) {
  py::list blocks;
  for (const BlockTraces& block : traces.blocks()) blocks.append(facts_of(block));
  return blocks;
}

}  // namespace

py::dict facts_of(const BlockTraces& block) {
  const PythonLeaf& leaf = *block.leaf;
  const Declarations& d = leaf.declarations();
  py::list inputs, functions;
  for (std::size_t i = 0; i < block.inputs.size(); ++i) {
    Shape shape = block.inputs[i];
    shape.vector = !leaf.number_input(static_cast<int>(i), shape.size, shape.columns);
    inputs.append(as_tuple(shape.vector ? dimensions_of(shape) : Dimensions{}));
  }
  for (int k = 0; k < count_of(leaf.functions()); ++k) functions.append(function_of(block, k));
  py::dict all;
  all["leaf"] = py::cast(&leaf, py::return_value_policy::reference);
  all["path"] = block.path;
  all["state_shape"] = as_tuple(leaf.state_dimensions());
  all["discrete_shape"] = as_tuple(leaf.discrete_dimensions());
  all["mode"] = d.mode;
  all["x"] = read_only_array({d.continuous.initial.size()}, d.continuous.initial.data());
  all["z"] = read_only_array({d.discrete.size()}, d.discrete.data());
  all["parameters"] = parameters_of(leaf);
  all["input_shapes"] = inputs;
  all["functions"] = functions;
  return all;
}

void bind_traces(py::module_& module) {
  py::class_<Trace>(module, "Trace").def(py::init(&make_trace));
  py::class_<Traces, std::shared_ptr<Traces>>(module, "Traces")
      .def(py::init<const System&>())
      .def_property_readonly("stale", &Traces::stale)
      .def_property_readonly("complete", &Traces::complete)
      .def("guess_shapes", &Traces::guess_shapes)
      .def("set", &Traces::set)
      .def("share", &Traces::share)
      .def("blocks", &facts_of_all);
  module.def("trace", &trace);
}

}  // namespace saltus::python
