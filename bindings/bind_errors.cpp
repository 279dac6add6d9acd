// C++ errors become the exceptions of python/saltus/errors.py. An exception of a Python function
// does not pass here: pybind11 rethrows it unchanged.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "saltus/base/error.hpp"

namespace saltus::python {

py::object error_class(const char* name) { return py::module_::import("saltus.errors").attr(name); }

void bind_errors(py::module_& module) {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const SimulationError& error) {
      const py::object python =
          error_class("SimulationError")(error.what(), error.time(), error.block());
      py::set_error(py::type::of(python), python);
    } catch (const ModelError& error) {
      py::set_error(error_class("ModelError"), error.what());
    } catch (const Error& error) {
      py::set_error(error_class("Error"), error.what());
    }
  });
  module.def("known_names", &known_names, "The end of a message about an unknown name.");
}

}  // namespace saltus::python
