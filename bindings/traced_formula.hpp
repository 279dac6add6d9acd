// The trace of a Python function as a formula, which a plan joins with those of its neighbours.
#pragma once

#include "saltus/model/formula.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::python {

/// The formula of a tape, with the same numbers to the last bit. Empty if the tape reads a discrete
/// state or the mode, which no formula reads.
Formula formula_of(const tape::Tape& tape);

}  // namespace saltus::python
