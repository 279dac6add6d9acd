#include "tape_compiler.hpp"

#include <atomic>
#include <cstdint>

#include <pybind11/stl.h>

#include "interpreter.hpp"
#include "saltus/tape/machine_code.hpp"

namespace saltus::python {

namespace {

std::atomic<bool> loaded = false;

/// Keeps an object of Python from any thread. When the interpreter has ended there is nothing left
/// to release.
std::shared_ptr<const void> kept(py::object object) {
  return {object.release().ptr(), [](PyObject* held) {
            if (Py_IsInitialized() == 0) return;
            locked([held] { Py_DECREF(held); });
          }};
}

/// saltus.jit.functions(module, count). Inside the call no object has a destructor: see
/// until_shutdown.
py::object compiled(const std::string& module, int count) {
  const py::str name("functions"), text(module);
  const py::int_ number(count);
  PyObject* const result = until_shutdown([&]() -> PyObject* {
    PyObject* const jit = PyImport_ImportModule("saltus.jit");
    if (jit == nullptr) return nullptr;
    PyObject* const made =
        PyObject_CallMethodObjArgs(jit, name.ptr(), text.ptr(), number.ptr(), nullptr);
    Py_DECREF(jit);
    return made;
  });
  if (result == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(result);
}

std::vector<tape::MachineCode> made(const std::string& module, int count) {
  const py::object result = compiled(module, count);
  const auto [addresses, library] =
      result.cast<std::pair<std::vector<std::uintptr_t>, py::object>>();
  const auto owner = kept(library);
  std::vector<tape::MachineCode> codes;
  for (const std::uintptr_t address : addresses)
    codes.push_back({reinterpret_cast<tape::MachineFunction>(address), owner});
  loaded = true;
  return codes;
}

}  // namespace

bool compiler_is_loaded() noexcept { return loaded; }

void compile_tapes(std::span<const tape::Tape> tapes, std::span<const tape::SeriesOrder> series,
                   bool required) {
  try {
    tape::compile(tapes, series, &made);
  } catch (py::error_already_set& error) {
    if (required || !error.matches(PyExc_Exception)) throw;
  }
}

}  // namespace saltus::python
