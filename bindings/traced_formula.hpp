// The trace of a Python function as a formula, which a plan joins with those of its neighbours.
#pragma once

#include "saltus/model/formula.hpp"
#include "trace.hpp"

namespace saltus::python {

/// The formula of the tape in the slot, with the same numbers to the last bit. A plan joins it with
/// others only if `joins` and if it reads neither a discrete state nor the mode. Empty if the tape
/// reads the entry of a reset map.
Formula formula_of(const Slot& slot, bool joins);

}  // namespace saltus::python
