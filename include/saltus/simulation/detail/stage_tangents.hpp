// StageTangents: the tangents of the steps of an explicit method, through its stages.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "saltus/simulation/detail/flow_terms.hpp"
#include "saltus/simulation/detail/integration.hpp"
#include "saltus/simulation/detail/variation.hpp"

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
  StageTangents(const Machine& machine, TangentFlow& flow) : flow_(&flow), terms_(machine, flow) {}

  /// A run begins.
  void begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol);
  /// The columns, or the flow, may have changed.
  void forget() { continues_ = has_step_ = false, chosen_ = false; }

  /// Carries the columns from `from` to `to` [s]. False if it does not, and nothing has changed then.
  bool advance(double from, double to, Integration& integration, TangentColumns& columns);
  /// Whether a switch of the flow has changed its side in that step.
  bool crossed_switch() const noexcept { return terms_.crossed(); }
  /// Whether the last step was taken here.
  bool has_step() const noexcept { return has_step_; }

  /// S at a time within that step. False where the solver has its stages no more.
  bool at(double t, Eigen::MatrixXd& s);
  /// Prepares for `at`, before an instant changes what the flow reads.
  bool prepare_inside();
  /// The polynomial of that step; none where the solver has its stages no more.
  std::optional<Variation::Piece> piece();
  /// The begin of that step [s], S there, and who has taken it.
  double from() const noexcept { return from_; }
  Eigen::MatrixXd begin_of_step() const { return s0_; }
  Integration& integration() const noexcept { return *integration_; }

 private:
  using Flat = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  void prepare(const StepStages& step, const TangentColumns& columns);
  bool is_good(const StepStages& step);
  void read(double t, Eigen::MatrixXd& s);

  TangentFlow* flow_;
  FlowTerms terms_;
  double rtol_ = 0.0, most_error_ = 1.0;  // [tolerances] the largest estimate
  Flat atol_;
  Eigen::VectorXd state_atol_;
  std::unique_ptr<ColumnSteps> steps_;
  decltype(StepStages::make) made_by_ = nullptr;
  int functions_ = -1;      // for which the terms were chosen
  bool chosen_ = false;     // the terms are those of the present columns
  bool continues_ = false;  // the last step ended where the next begins
  bool has_step_ = false;   // the last step was taken here
  bool dense_ready_ = false;
  double from_ = 0.0, to_ = 0.0, t1_ = 0.0, h_ = 0.0;  // [s] of the last step
  Integration* integration_ = nullptr;                 // that has taken it
  Flat s0_, s1_, inside_;                              // S at both ends, and at a time inside
  Flat allowed_;  // the absolute tolerance of each entry in that step
};

}  // namespace saltus
