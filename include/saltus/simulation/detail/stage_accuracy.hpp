// StageAccuracy: whether S is good enough after a step through the stages of the solver.
#pragma once

#include "saltus/simulation/detail/stage_step.hpp"

namespace saltus {

/// S is as good as the states are where these have chosen the size of the step by their error: S has
/// one of the same kind. Where they rest they have none, and steps are as long as stability allows,
/// or longer: the factor of a discrete step has nothing to do with the flow there.
class StageAccuracy {
 public:
  /// A run begins, with the tolerances of S and of the states.
  void begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol);
  /// Judges S at both ends of a step of `steps`. `crossed`: a switch of the flow changed its side in it.
  bool is_good(ColumnSteps& steps, const StepStages& step, const StageStep::Flat& s0,
               const StageStep::Flat& s1, bool crossed);

 private:
  double rtol_ = 0.0, most_error_ = 1.0;  // [tolerances] the largest estimate
  StageStep::Flat atol_;
  Eigen::VectorXd state_atol_;
  StageStep::Flat allowed_;  // the absolute tolerance of each entry in that step
};

}  // namespace saltus
