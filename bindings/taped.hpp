// The functions of a Python block that run its tapes.
#pragma once

#include <vector>

#include "traces.hpp"

namespace saltus::python {

/// Runs the tape in the slot. A result that is not finite is left to the function itself, which may
/// raise, or warn.
struct Taped {
  Slot slot;
  VectorFunction called;  // the function itself
  const PythonLeaf* leaf;
  void operator()(const At& at, VectorRef out) const;
};
VectorFunction taped(const PythonLeaf& leaf, const Slot& slot);

/// The same for a Jacobian, whose tape returns the matrix row by row.
struct TapedMatrix {
  Taped rows;
  void operator()(const At& at, MatrixRef out) const;
};
MatrixFunction taped_matrix(const PythonLeaf& leaf, const Slot& slot);

/// The derivatives of a tape, at the places of their Jacobian that may differ from zero.
struct TapedEntries {
  Slot slot;
  void operator()(const At& at, VectorRef out) const;
};

/// The same for a reset map or an update. Its tape returns the parts of x+, z+, mode+ that it
/// writes, one after the other. `called` is the function itself.
struct TapedReset {
  Slot slot;
  ResetMap called;
  const PythonLeaf* leaf;
  void operator()(const At& at, Next& next) const;
};

/// The same for the reset map of an event input.
struct TapedDelivery {
  TapedReset reset;
  void operator()(const At& at, Delivery& next) const { reset(at, next); }
};

/// The same matrix with these entries: zero where it has none, without those it has beyond.
tape::Jacobian at_places(const tape::Jacobian& jacobian, const std::vector<MatrixEntry>& places);

/// The tapes that a function runs, which may be none.
std::vector<tape::Tape> tapes_of(const VectorFunction& function);
std::vector<tape::Tape> tapes_of(const MatrixFunction& function);
std::vector<tape::Tape> tapes_of(const ResetMap& function);
std::vector<tape::Tape> tapes_of(const DeliveryMap& function);

}  // namespace saltus::python
