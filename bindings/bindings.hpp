// Declarations shared by the binding files. They carry the C++ names; defaults and docstrings are
// in python/saltus/*.py.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>

namespace saltus {
class Context;
class ModelError;
class SimulationError;
}  // namespace saltus

namespace saltus::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_numbers(py::module_& module);
void bind_context(py::module_& module);
void bind_context_saving(py::class_<Context>& context);
void bind_context_reading(py::module_& module);
void bind_system(py::module_& module);
void bind_picture(py::module_& module);
void bind_leaf_system(py::module_& module);
void bind_callback_state(py::module_& module);
void bind_traces(py::module_& module);
void bind_sources(py::module_& module);
void bind_arithmetic(py::module_& module);
void bind_logic(py::module_& module);
void bind_state(py::module_& module);
void bind_linear(py::module_& module);
void bind_discrete(py::module_& module);
void bind_results(py::module_& module);
void bind_simulation(py::module_& module);
void bind_evaluate(py::module_& module);
void bind_linearize(py::module_& module);
void bind_ensemble(py::module_& module);
void bind_shelf(py::module_& module);
void bind_report(py::module_& module);
void bind_tape(py::module_& module);

/// An exception class of python/saltus/errors.py.
py::object error_class(const char* name);
/// The exception of Python for an error of a run, and for one of a model: of this class, with its cause.
py::object as_python(const SimulationError& error);
py::object as_python(const ModelError& error, const char* name);

}  // namespace saltus::python
