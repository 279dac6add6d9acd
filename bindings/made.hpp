// Whether the Python object of a block contains a block already.
#pragma once

#include "bindings.hpp"

namespace saltus::python {

/// The object contains no block while pybind11 makes it, nor ever if its constructor throws. The
/// garbage collector or a traceback may look at it then, even before it has room for a block.
inline bool holds_block(PyObject* self) {
  const auto* object = reinterpret_cast<const py::detail::instance*>(self);
  if (!object->simple_layout && object->nonsimple.status == nullptr) return false;
  return py::detail::is_holder_constructed(self);
}

}  // namespace saltus::python
