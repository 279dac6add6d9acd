// C++ errors become the exceptions of python/saltus/errors.py. An exception of a Python function
// does not pass here: pybind11 rethrows it unchanged.
#include <pybind11/stl.h>

#include <type_traits>

#include "bindings.hpp"
#include "interpreter.hpp"
#include "saltus/base/model_errors.hpp"

namespace saltus::python {

py::object error_class(const char* name) { return py::module_::import("saltus.errors").attr(name); }

namespace {

/// The name of the class of a model error.
const char* class_of(const ModelError& error) {
  const auto is = [&]<class Kind>(std::type_identity<Kind>) {
    return dynamic_cast<const Kind*>(&error) != nullptr;
  };
  if (is(std::type_identity<SystemNameNotUniqueError>())) return "SystemNameNotUniqueError";
  if (is(std::type_identity<EmptyDiagramError>())) return "EmptyDiagramError";
  if (is(std::type_identity<BuilderError>())) return "BuilderError";
  if (is(std::type_identity<BlockParameterError>())) return "BlockParameterError";
  if (is(std::type_identity<InputNotConnectedError>())) return "InputNotConnectedError";
  if (is(std::type_identity<AlgebraicLoopError>())) return "AlgebraicLoopError";
  if (is(std::type_identity<ShapeMismatchError>())) return "ShapeMismatchError";
  return is(std::type_identity<StaticError>()) ? "StaticError" : "ModelError";
}

/// An exception of Python gets what a function of the user raised as its `__cause__`; nothing if `cause`
/// is null or no exception of Python.
void set_cause(py::handle exception, const std::exception_ptr& cause) {
  if (!cause) return;
  try {
    std::rethrow_exception(cause);
  } catch (const py::error_already_set& raised) {
    if (raised.trace()) PyException_SetTraceback(raised.value().ptr(), raised.trace().ptr());
    PyException_SetCause(exception.ptr(), raised.value().inc_ref().ptr());
  } catch (const std::exception&) {  // of C++: the message has its words
  }
}

}  // namespace

py::object as_python(const SimulationError& error) {
  return ask(error_class("SimulationError"), error.what(), error.time(), error.block());
}

py::object as_python(const ModelError& error, const char* name) {
  py::object python = ask(error_class(name), error.what());
  set_cause(python, error.cause());
  return python;
}

void bind_errors(py::module_& module) {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const SimulationError& error) {
      const py::object python = as_python(error);
      py::set_error(py::type::of(python), python);
    } catch (const ModelError& error) {
      const py::object python = as_python(error, class_of(error));
      py::set_error(py::type::of(python), python);
    } catch (const Error& error) {
      py::set_error(error_class("Error"), error.what());
    }
  });
  module.def("known_names", &known_names, "The end of a message about an unknown name.");
}

}  // namespace saltus::python
