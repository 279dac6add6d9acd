// The error of S in a step beside that of the states.
#include "saltus/simulation/detail/stage_accuracy.hpp"

#include <algorithm>
#include <utility>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

void StageAccuracy::begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol) {
  using namespace thresholds;
  rtol_ = tolerances.rtol + stage_rounding * thresholds::eps;
  atol_ = tolerances.atol, state_atol_ = std::move(state_atol);
  most_error_ = std::clamp(most_stage_share / rtol_, 1.0, most_stage_error);
}

bool StageAccuracy::is_good(ColumnSteps& steps, const StepStages& step, const StageStep::Flat& s0,
                            const StageStep::Flat& s1, bool crossed) {
  using namespace thresholds;
  // The absolute tolerance is in units of the parameter, and means nothing where that is tiny.
  allowed_ = atol_;
  for (Index k = 0; k < s0.cols(); ++k) {
    const double size = std::max(s0.col(k).cwiseAbs().maxCoeff(), s1.col(k).cwiseAbs().maxCoeff());
    if (rtol_ * size > 0.0) allowed_.col(k) = allowed_.col(k).cwiseMin(rtol_ * size);
  }
  const double error = steps.error(step, {rtol_, allowed_.data()}, s0.data(), s1.data());
  if (error <= free_stage_error) return true;
  if (crossed) return error <= 1.0;
  const double of_states = steps.state_error(step, {rtol_, state_atol_.data()});
  return error <= most_error_ * std::min(of_states, 1.0);
}

}  // namespace saltus
