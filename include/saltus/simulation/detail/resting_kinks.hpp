// RestingKinks: the columns that lead off a kink of the flow, at which the state rests.
#pragma once

#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/simulation/detail/tangent_gaps.hpp"

namespace saltus {

/// A flow with a kink has no derivative for a state that rests at it, as x' = -|x| at x = 0. A state that
/// goes through it has one.
class RestingKinks {
 public:
  RestingKinks(const Machine& machine, TangentFlow& flow, TangentProbe& probe)
      : machine_(&machine), flow_(&flow), probe_(&probe) {}

  /// Loses the columns, those of the state at t [s], that lead off such a kink.
  void look(double t, const TangentColumns& columns, TangentGaps& gaps);

 private:
  bool bends_soon(double t, const TangentColumns& columns, Index k, const Eigen::MatrixXd& a,
                  const Eigen::MatrixXd& b);

  const Machine* machine_;
  TangentFlow* flow_;
  TangentProbe* probe_;
};

}  // namespace saltus
