// StageTangents: step by step.
#include "saltus/simulation/detail/stage_tangents.hpp"

#include <utility>

namespace saltus {

void StageTangents::begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol) {
  accuracy_.begin(std::move(tolerances), std::move(state_atol));
  made_by_ = nullptr;
  forget();
}

/// Makes what the columns need, unless they continue.
void StageTangents::prepare(const StepStages& step, const TangentColumns& columns) {
  if (made_by_ != step.make) {
    steps_ = step.make(columns.x.rows(), columns.size());
    made_by_ = step.make, chosen_ = false;
  }
  if (!chosen_) terms_.choose(columns);
  chosen_ = true;
}

bool StageTangents::advance(double from, double to, Integration& integration,
                            TangentColumns& columns) {
  const int functions = flow_->renew();
  if (std::exchange(functions_, functions) != functions) forget();
  const bool continues = std::exchange(continues_, false);
  last_.forget();
  if (!flow_->exact() || columns.x.size() == 0) return false;
  const StepStages step = integration.stages();
  if (!step || step.t0 != from || !(to <= step.t1)) return false;
  prepare(step, columns);
  last_.begin(columns.x);
  terms_.watch(continues);
  steps_->step(step, terms_, last_.s0().data(), last_.s1().data(), continues);
  terms_.end_step();
  if (!accuracy_.is_good(*steps_, step, last_.s0(), last_.s1(), terms_.crossed())) return false;
  last_.take({from, to, step.t1, step.h, &integration, steps_.get()});
  if (to == step.t1) {
    columns.x = last_.s1(), continues_ = true;
    return true;
  }
  if (last_.at(to, columns.x)) return true;
  last_.forget();
  return false;
}

}  // namespace saltus
