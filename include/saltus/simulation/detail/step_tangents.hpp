// StepTangents: the derivatives along the steps of the solver, and inside the last one.
#pragma once

#include <optional>
#include <vector>

#include "saltus/simulation/detail/flow_jumps.hpp"
#include "saltus/simulation/detail/flow_switches.hpp"
#include "saltus/simulation/detail/integration.hpp"
#include "saltus/simulation/detail/stage_tangents.hpp"
#include "saltus/simulation/detail/tangent_gaps.hpp"
#include "saltus/simulation/detail/time_jumps.hpp"
#include "saltus/simulation/detail/variation.hpp"

namespace saltus {

/// Solves the linear equation S' = f_x S + f_p: through the stages of the solver where they are exact
/// and good enough, else by collocation. The columns belong to the caller, who hands them over.
class StepTangents {
 public:
  StepTangents(const Machine& machine, TangentFlow& flow, TangentProbe& probe, TangentGaps& gaps,
               FlowSwitches& switches)
      : machine_(&machine),
        flow_(&flow),
        probe_(&probe),
        gaps_(&gaps),
        switches_(&switches),
        jumps_(flow, probe),
        called_jumps_(probe),
        stages_(machine, flow) {}

  /// A run begins, with the tolerances of S and of the states.
  void begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol);
  /// Whether a run has begun.
  bool begun() const noexcept { return variation_.has_value(); }
  /// An instant has changed the columns, or the flow.
  void forget() { variation_->forget(), stages_.forget(); }

  /// Carries the columns along a step from `from` to `to` [s].
  void advance(double from, double to, Integration& integration, TangentColumns& columns);
  /// The states of the columns at t [s] within the last step; `at` are the columns at its end. They
  /// stay as they are if there was no step.
  void inside(double t, TangentColumns& at);
  /// Finds S inside the last step while the flow is still that of the step, which an instant may change.
  void keep_inside(const TangentColumns& columns) {
    if (stages_.last().is_there()) need_inside(columns);
  }
  /// S in the last step, piece by piece; none where the solver took no step.
  const std::vector<Variation::Piece>& pieces(const TangentColumns& columns) {
    keep_inside(columns);
    return variation_->pieces();
  }

 private:
  void solve(double from, double to, Integration& integration, TangentColumns& columns);
  bool solve_across_jumps(double from, double to, Integration& integration,
                          TangentColumns& columns);
  void carry(double from, double to, Integration& integration, TangentColumns& columns);
  void add(const FlowJump& jump, double t, TangentColumns& columns);
  Eigen::VectorXd state_at(double t, Integration& integration) const;
  void collocate(double from, double to, Integration& integration, const TangentColumns& columns,
                 Eigen::MatrixXd& s);
  void need_inside(const TangentColumns& columns);
  void look_for_jump(double from, double to, Integration& integration,
                     const TangentColumns& columns);

  const Machine* machine_;
  TangentFlow* flow_;
  TangentProbe* probe_;
  TangentGaps* gaps_;
  FlowSwitches* switches_;
  FlowJumps jumps_;
  TimeJumps called_jumps_;
  StageTangents stages_;
  std::optional<Variation> variation_;
  double to_ = 0.0;  // [s] the end of the last step
};

}  // namespace saltus
