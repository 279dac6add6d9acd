// What Python sees of a C++ Results.
#pragma once

#include <memory>

#include "bindings.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus::python {

/// The Python exception for what ended a run: as it was raised, if Python code raised it. None if
/// nothing was thrown.
py::object cause_of(const Results& results);

}  // namespace saltus::python
