// The functions of a Python block that run its tapes.
#pragma once

#include <vector>

#include "traces.hpp"

namespace saltus::python {

/// A function that runs the tape in the slot. What is not finite is left to the function itself,
/// which may raise, or warn.
VectorFunction taped(const PythonLeaf& leaf, const Slot& slot);

/// The same for a Jacobian, whose tape returns the matrix row by row.
MatrixFunction taped_matrix(const PythonLeaf& leaf, const Slot& slot);

/// The same for a reset map or an update. Its tape returns the parts of x+, z+, mode+ that it writes,
/// one after the other. `called` is the function itself.
ResetMap taped_reset(const PythonLeaf& leaf, Slot slot, ResetMap called);

/// The same matrix with these entries: zero where it has none, without those it has beyond.
tape::Jacobian at_places(const tape::Jacobian& jacobian, const std::vector<MatrixEntry>& places);

}  // namespace saltus::python
