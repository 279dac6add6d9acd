// GuardsAtZero: the guards at zero in an instant, which a parameter would move off it.
#pragma once

#include <string>
#include <vector>

#include "saltus/simulation/detail/other_truth.hpp"
#include "saltus/simulation/detail/present.hpp"
#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/simulation/detail/tangent_gaps.hpp"
#include "saltus/solver/detail/guard_set.hpp"

namespace saltus {

/// Finds the parameters for which an event exists, or comes first, on one side only. It changes no
/// guard. Of the columns it changes only those whose derivative it finds to be lost.
class GuardsAtZero {
 public:
  /// The guards and the columns stay with their owners.
  GuardsAtZero(const Machine& machine, const GuardSet& guards, TangentFlow& flow,
               TangentProbe& probe, const TangentColumns& columns, TangentGaps& gaps)
      : machine_(&machine),
        guards_(&guards),
        flow_(&flow),
        probe_(&probe),
        columns_(&columns),
        gaps_(&gaps),
        truths_(machine, probe, columns) {}

  /// A run begins: no guard has been seen.
  void begin() { sizes_.setZero(machine_->plan().look_slots); }

  /// An instant opens where the flow is `flow`, with the columns `until` before it. Returns the guards
  /// that are about to fire, within the rounding of their values, beside the event that caused it.
  std::vector<std::size_t> beside(const Present& present, const TangentColumns& until,
                                  const Eigen::VectorXd& flow, bool caused);
  /// These guards fire in the next pass. A guard that fires without a root was at zero already, where
  /// the run began or where an effect put it.
  void look_at_firings(const Present& present);
  /// An instant at t [s] ends. A guard may wait at exactly zero where a run began or where a write has
  /// put it, and the flow take it on in its firing direction. It does not fire then.
  void look_at_waiting(double t);

 private:
  GuardTangent tangent(double t, std::size_t guard, const TangentColumns& columns);
  double rounding_of(const GuardTangent& guard, double t, const Eigen::VectorXd& flow) const;
  bool is_about_to_fire(std::size_t guard, double g, double t, const TangentColumns& until,
                        const Eigen::VectorXd& flow);
  bool waits(std::size_t guard) const;
  void look_at_waiting(double t, std::size_t guard, const Eigen::VectorXd& flow);

  const Machine* machine_;
  const GuardSet* guards_;
  TangentFlow* flow_;
  TangentProbe* probe_;
  const TangentColumns* columns_;
  TangentGaps* gaps_;
  OtherTruth truths_;
  Eigen::VectorXd sizes_;  // the largest value of each guard so far
};

}  // namespace saltus
