// The result of tracing one function of a Python block.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "saltus/tape/jacobian.hpp"

namespace saltus::python {

/// A truth made of comparisons: a guard for each comparison, the truth of each at zero, and a tape
/// that computes the truth from theirs, which it reads as a discrete state.
struct TracedRelations {
  tape::Tape differences;
  std::vector<bool> true_at_zero;
  tape::Tape truth;
};

struct Trace {
  int serial;    // a different number for each trace
  int function;  // its number in the block
  tape::Tape tape;
  std::optional<TracedRelations> relations;
  bool wrote_x = false, wrote_z = false, wrote_mode = false;  // the outputs of a reset or an update
  std::optional<tape::Jacobian> jacobian;                     // of an ode
};

/// The place where the functions of a plan find their tape, so that a run in pieces can get a new
/// tape between two pieces.
using Slot = std::shared_ptr<Trace>;

}  // namespace saltus::python
