// StageTangents: step by step, and inside a step.
#include "saltus/simulation/detail/stage_tangents.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

void StageTangents::begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol) {
  using namespace thresholds;
  rtol_ = tolerances.rtol + stage_rounding * thresholds::eps;
  atol_ = tolerances.atol, state_atol_ = std::move(state_atol);
  most_error_ = std::clamp(most_stage_share / rtol_, 1.0, most_stage_error);
  made_by_ = nullptr;
  forget();
}

/// Makes what the columns need, unless they continue.
void StageTangents::prepare(const StepStages& step, const TangentColumns& columns) {
  if (made_by_ != step.make) {
    steps_ = step.make(columns.x.rows(), columns.size());
    made_by_ = step.make, chosen_ = false;
    s1_.resize(columns.x.rows(), columns.size());
  }
  if (!chosen_) terms_.choose(columns);
  chosen_ = true;
}

bool StageTangents::advance(double from, double to, Integration& integration,
                            TangentColumns& columns) {
  const int functions = flow_->renew();
  if (std::exchange(functions_, functions) != functions) forget();
  const bool continues = std::exchange(continues_, false);
  has_step_ = false;
  if (!flow_->exact() || columns.x.size() == 0) return false;
  const StepStages step = integration.stages();
  if (!step || step.t0 != from || !(to <= step.t1)) return false;
  prepare(step, columns);
  s0_ = columns.x;
  terms_.watch(continues);
  steps_->step(step, terms_, s0_.data(), s1_.data(), continues);
  terms_.end_step();
  if (!is_good(step)) return false;
  from_ = from, to_ = to, t1_ = step.t1, h_ = step.h;
  integration_ = &integration;
  dense_ready_ = false, has_step_ = true;
  if (to == step.t1) {
    columns.x = s1_, continues_ = true;
    return true;
  }
  has_step_ = prepare_inside();
  if (has_step_) read(to, columns.x);
  return has_step_;
}

/// Whether S is as good as the states are. Where they have chosen the size of the step by their error, S
/// has one of the same kind. Where they rest they have none, and steps are as long as stability
/// allows, or longer: the factor of a discrete step has nothing to do with the flow there.
bool StageTangents::is_good(const StepStages& step) {
  using namespace thresholds;
  // The absolute tolerance is in units of the parameter, and means nothing where that is tiny.
  allowed_ = atol_;
  for (Index k = 0; k < s0_.cols(); ++k) {
    const double size =
        std::max(s0_.col(k).cwiseAbs().maxCoeff(), s1_.col(k).cwiseAbs().maxCoeff());
    if (rtol_ * size > 0.0) allowed_.col(k) = allowed_.col(k).cwiseMin(rtol_ * size);
  }
  const double error = steps_->error(step, {rtol_, allowed_.data()}, s0_.data(), s1_.data());
  if (error <= free_stage_error) return true;
  if (terms_.crossed()) return error <= 1.0;
  const double of_states = steps_->state_error(step, {rtol_, state_atol_.data()});
  return error <= most_error_ * std::min(of_states, 1.0);
}

bool StageTangents::prepare_inside() {
  if (dense_ready_) return true;
  Eigen::VectorXd x(s0_.rows());
  integration_->interpolate(from_ + 0.5 * h_, x.data());  // the solver makes its dense output
  const StepStages step = integration_->stages();
  if (!step || step.t0 != from_ || !step.dense) return false;
  steps_->prepare_dense(step, terms_, s0_.data(), s1_.data());
  inside_.resize(s0_.rows(), s0_.cols());
  return dense_ready_ = true;
}

void StageTangents::read(double t, Eigen::MatrixXd& s) {
  if (t == t1_) return s = s1_, void();
  steps_->read((t - from_) / h_, s0_.data(), inside_.data());
  s = inside_;
}

bool StageTangents::at(double t, Eigen::MatrixXd& s) {
  if (!(from_ <= t && t <= to_) || !prepare_inside()) return false;
  read(t, s);
  return true;
}

std::optional<Variation::Piece> StageTangents::piece() {
  if (!prepare_inside()) return {};
  const std::size_t count = steps_->degree() < static_cast<int>(Variation::few_nodes)
                                ? Variation::few_nodes
                                : Variation::most_nodes;
  Variation::Piece piece{from_, to_, {}};
  for (const double node : Variation::nodes_of(count))
    read(node == 1.0 ? to_ : from_ + node * (to_ - from_), piece.s.emplace_back());
  return piece;
}

}  // namespace saltus
