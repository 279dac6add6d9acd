// A zero crossing declared from Python.
#pragma once

#include "python_leaf.hpp"

namespace saltus::python {

/// The options are one dict with every key; python/saltus/leaf_system.py documents their defaults
/// and meaning.
void declare_zero_crossing(py::handle self, py::object guard, py::object reset_map,
                           std::string name, const py::dict& options);

}  // namespace saltus::python
