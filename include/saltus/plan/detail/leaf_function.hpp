// LeafFunction: one function of a leaf of a plan, and its derivatives by the values that it reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/plan/plan.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus {

/// An entry of the state, of the parameters or of the signals: a value that a function reads.
struct ReadValue {
  Space space = Space::x;
  Index index = 0;
  auto operator<=>(const ReadValue&) const = default;
};

/// The values of a function that has a formula, and its derivatives, as one tape over the whole
/// machine (see FlowVariables). The tape computes `size` values, then the derivatives, then the
/// operands of the switches.
struct LeafPartials {
  struct Entry {
    Index row = 0;
    std::size_t read = 0;  ///< its number among the values that the function reads
  };
  std::vector<Entry> entries;
  Index switches = 0;  ///< the number of switches, see tape/switches.hpp
  tape::Tape tape;
};

/// The declared derivative of the rates of a leaf by its own state, where inputs count as constants.
struct DeclaredJacobian {
  const ContinuousState* state = nullptr;  ///< null, or without a Jacobian: nothing is declared

  explicit operator bool() const noexcept {
    return state != nullptr && (state->jacobian || state->sparse_jacobian);
  }
};

/// An output, a relation, a guard or the derivative of a leaf.
struct LeafFunction {
  std::string name;  ///< "the derivative of block 'ball'"
  int leaf = -1;
  Index size = 0;
  const VectorFunction* call = nullptr;              ///< null: zero
  std::vector<ReadValue> reads = {};                 ///< all but truths, the mode and the time
  std::optional<LeafPartials> partials = {};         ///< none: the function is called
  const DerivativesFunction* derivatives = nullptr;  ///< null or empty: none are declared
  DeclaredJacobian jacobian = {};

  bool declares_derivatives() const { return derivatives != nullptr && *derivatives; }
};

/// The output or relation of a node. It must not be a view.
LeafFunction function_of_node(const Plan& plan, int node);
/// The derivative of a leaf that has a continuous state.
LeafFunction function_of_rates(const Plan& plan, int leaf);
/// A group of zero crossings.
LeafFunction function_of_guard(const Plan& plan, const GuardGroup& group);
/// The nodes that this group of zero crossings reads.
std::vector<int> nodes_of_guard(const Plan& plan, const GuardGroup& group);
/// The same for a group of any kind.
std::vector<int> nodes_read(const Plan& plan, const GuardGroup& group);

}  // namespace saltus
