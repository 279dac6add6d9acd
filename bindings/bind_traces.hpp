// A Python block as python/saltus/callbacks/ sees it.
#pragma once

#include "numbers.hpp"
#include "traces.hpp"

namespace saltus::python {

/// Its shapes, start values, parameters and functions.
py::dict facts_of(const BlockTraces& block);

}  // namespace saltus::python
