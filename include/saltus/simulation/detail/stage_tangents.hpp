// StageTangents: the tangents of the steps of an explicit method, through its stages.
#pragma once

#include <memory>

#include "saltus/simulation/detail/stage_accuracy.hpp"
#include "saltus/simulation/detail/stage_step.hpp"

namespace saltus {

/// Carries S through the stages that the solver has just computed, which is the derivative of the
/// discrete step, and through its dense output. That needs one evaluation of the derivatives a stage,
/// no linear solve, and no call of f. It takes no step
/// - of a flow with a function that is called, or of a method without stages;
/// - that goes on behind an event inside of it: S has changed there;
/// - whose error estimate for S is too large beside that of the states, which have chosen the size of the
///   step: S may move where they rest. Where a switch of the flow changes its side in the step, f_x may
///   jump, and one tolerance is the most.
class StageTangents {
 public:
  StageTangents(const Machine& machine, TangentFlow& flow)
      : flow_(&flow), terms_(machine, flow), last_(terms_) {}
  StageTangents(const StageTangents&) = delete;  // its last step refers to it

  /// A run begins.
  void begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol);
  /// The columns, or the flow, may have changed.
  void forget() { continues_ = chosen_ = false, last_.forget(); }

  /// Carries the columns from `from` to `to` [s]. False if it does not, and nothing has changed then.
  bool advance(double from, double to, Integration& integration, TangentColumns& columns);
  /// Whether a switch of the flow has changed its side in that step.
  bool crossed_switch() const noexcept { return terms_.crossed(); }
  /// That step. It is not there if the last step was not taken here.
  StageStep& last() noexcept { return last_; }

 private:
  void prepare(const StepStages& step, const TangentColumns& columns);

  TangentFlow* flow_;
  FlowTerms terms_;
  StageAccuracy accuracy_;
  std::unique_ptr<ColumnSteps> steps_;
  decltype(StepStages::make) made_by_ = nullptr;
  int functions_ = -1;      // for which the terms were chosen
  bool chosen_ = false;     // the terms are those of the present columns
  bool continues_ = false;  // the last step ended where the next begins
  StageStep last_;
};

}  // namespace saltus
