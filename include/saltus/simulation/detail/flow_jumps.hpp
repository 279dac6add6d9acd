// FlowJumps: whether the derivative of a scene jumps along a step, without an event.
#pragma once

#include <functional>

#include "saltus/simulation/detail/tangent_flow.hpp"

namespace saltus {

/// Compares how f changes along a step with the sum of its derivatives there. The halves of a step are
/// halved where they differ: what is left of a smooth f falls with the cube of their length, and a
/// jump does not fall.
class FlowJumps {
 public:
  using StateAt = std::function<Eigen::VectorXd(double t)>;

  FlowJumps(TangentFlow& flow, TangentProbe& probe) : flow_(&flow), probe_(&probe) {}

  /// A run of n states begins.
  void begin(Index n) { rates_.setZero(n); }
  /// Whether f jumps between these times [s] because the state moves.
  bool within(double from, double to, const StateAt& state, const TangentColumns& columns);

 private:
  double jump_of(double from, double to, const StateAt& state, const TangentColumns& columns);

  TangentFlow* flow_;
  TangentProbe* probe_;
  Eigen::VectorXd rates_;  // the largest of each derivative so far
};

}  // namespace saltus
