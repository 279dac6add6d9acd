// What tracing made of one function of a Python block.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "saltus/tape/jacobian.hpp"

namespace saltus::python {

/// A truth made of comparisons: guards, one a comparison, what zero means to each, and the truth
/// over theirs, which it reads as a discrete state.
struct TracedRelations {
  tape::Tape differences;
  std::vector<bool> true_at_zero;
  tape::Tape truth;
};

struct Trace {
  int serial;    // another one for each
  int function;  // its number in the block
  tape::Tape tape;
  std::optional<TracedRelations> relations;
  bool wrote_x = false, wrote_z = false, wrote_mode = false;  // the outputs of a reset or an update
  std::optional<tape::Jacobian> jacobian;                     // of an ode
};

/// Where the functions of a plan look their tape up, so that a run in pieces gets a new one between
/// two pieces.
using Slot = std::shared_ptr<Trace>;

}  // namespace saltus::python
