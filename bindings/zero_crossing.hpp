// A zero crossing declared from Python.
#pragma once

#include "python_leaf.hpp"

namespace saltus::python {

/// Options come as one dict, with every key; defaults and what they mean stand in
/// python/saltus/leaf_system.py.
void declare_zero_crossing(py::handle self, py::object guard, py::object reset_map,
                           std::string name, const py::dict& options);

}  // namespace saltus::python
