// Zero crossings and edge resets declared from Python.
#pragma once

#include "python_leaf.hpp"

namespace saltus::python {

/// The options are one dict with every key; python/saltus/leaf_system/guards.py documents their
/// defaults and meaning.
void declare_zero_crossing(py::handle self, py::object guard, py::object reset_map,
                           std::string name, const py::dict& options);

/// A reset at an edge of an input; its options come as one dict, too.
void declare_edge_reset(py::handle self, py::object reset_map, int input, std::string name,
                        const py::dict& options);

/// An input for events of other blocks.
void declare_event_input(py::handle self, py::object reset_map, std::string name, Index size,
                         const InputList& inputs);

}  // namespace saltus::python
