// OtherTruth: what would be otherwise if a relation had the other truth.
#pragma once

#include "saltus/simulation/detail/tangent_probe.hpp"

namespace saltus {

/// A relation that is at its root has no derivative by a parameter if its truth decides something
/// there. A relation whose both truths lead to one flow, as that of a Saturation at its limit, has one.
class OtherTruth {
 public:
  /// The columns stay with their owner.
  OtherTruth(const Machine& machine, TangentProbe& probe, const TangentColumns& columns)
      : machine_(&machine), probe_(&probe), columns_(&columns) {}

  /// Whether a relation decides more at t [s] than a kink of the flow: the flow itself, or an edge.
  bool decides(const GuardGroup& group, Index entry, double t, const Eigen::VectorXd& flow);
  /// Whether the flow beside a relation at rest depends on its truth in first order, along column k:
  /// the kink of an Abs of a state that rests at zero.
  bool bends(const GuardGroup& group, Index entry, double t, Index k);

 private:
  Eigen::VectorXd flow_with(const GuardGroup& group, Index entry, bool other, double t, Index k,
                            double shift);

  const Machine* machine_;
  TangentProbe* probe_;
  const TangentColumns* columns_;
};

}  // namespace saltus
