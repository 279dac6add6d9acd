// C++ Results as a Python object.
#pragma once

#include <memory>

#include "bindings.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus::python {

/// The Python exception that ended a run, unchanged if Python code raised it. None if nothing was
/// thrown.
py::object cause_of(const Results& results);

}  // namespace saltus::python
