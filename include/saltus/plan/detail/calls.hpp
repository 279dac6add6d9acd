// Calls: the lists of a plan as calls of functions on one memory.
#pragma once

#include <optional>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

/// A function of a leaf with everything that a call needs, because it is called some ten times a
/// step.
struct Call {
  const VectorFunction* function;
  const LeafSystem* system;
  std::size_t leaf;
  At* at;         // the arguments of the leaf
  Index x, size;  // the first of the leaf's states, and their number
};
struct OutputCall : Call {
  Index to, width;  // in y
  bool relation, true_at_zero;
};
struct GuardCall : Call {
  Index slot, width;
  bool opaque;
};

/// The part of Calls::guard_needs that one group of guards needs.
struct GuardCone {
  bool whole = true;     ///< all of it
  List<int> calls = {};  ///< otherwise: their places there, in ascending order
};

/// The calls of a machine. They point to the views from which they were made.
struct Calls {
  Calls() = default;
  /// `views`: the arguments of each leaf, then those of a function over the whole machine.
  Calls(const Plan& plan, std::vector<At>& views);

  std::vector<OutputCall> constants, instants, moving, derivatives, guard_needs, taps, histories;
  std::vector<OutputCall> needs_of_derivatives;  // each with its own call, where formulas are fused
  std::vector<Call> odes;                        // of leaves that have one, and the fused function
  std::vector<Call> single_odes;                 // each with its own call
  List<GuardCall> guards;
  List<GuardCone> guard_cones;  // of each group
  std::optional<GuardCall> fused_guards;
};

}  // namespace saltus
