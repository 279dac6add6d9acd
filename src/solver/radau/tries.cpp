// Tries of a step: whether one is good enough, and how long the next one is if it is not.
#include <algorithm>
#include <cmath>

#include "saltus/solver/detail/radau/creep.hpp"
#include "saltus/solver/detail/step_size.hpp"
#include "solver.hpp"

namespace saltus::radau {

double RadauSolver::judged(double h) {
  const double error = estimate(h);
  if (!damping_.by(h) || !std::isfinite(error)) return error;
  if (damping_.allows(error_.largest())) return std::min(error, 1.0);
  damping_.end();
  return error;
}

double RadauSolver::estimate(double h) {
  finish_stages(h);
  return error_.look(stages_, {t0_, &x0_, &f0_, h}, step_, x1_);
}

bool RadauSolver::ends_finite() {
  machine_->derivative(t1_, x1_.data(), f1_.data());
  f1_known_ = true;
  return x1_.allFinite() && f1_.allFinite();
}

double RadauSolver::retry_after_failure(double h) {
  ++statistics_.rejected;
  if (!stages_.finite()) note_not_finite(h);
  const double shorter = h * stages_.shorter();
  damping_.end();
  choice_.newton_failed();
  step_.stages = choice_.stages();
  error_.forget_tries();
  return shorter;
}

double RadauSolver::retry_after_jump(double h) {
  ++statistics_.rejected;
  note_not_finite(h);
  return h * thresholds::blind_retry;
}

double RadauSolver::retry_after_error(double error, double h, bool rejected, double t_stop) {
  ++statistics_.rejected;
  const double shorter = choice_.reject(error, h, stages_.convergence());
  // After a jump the steps before it say nothing, and the estimate of fast parts hardly shrinks
  // with h until it resolves them.
  if (smooth_ || rejected || damping_.goes_on()) return shorter;
  return std::min(shorter, careful_step(t_stop));
}

bool RadauSolver::creep(double h) {
  for (int j = 0; j < step_.stages; ++j) step_.z.col(j) = scheme().c[j] * h * f0_;
  finish_stages(h);
  error_.set_size(in_tolerances(step_.end()));
  if (!is_small(error_.size())) return false;
  bool jumped = false;
  for (int j = 0; j < step_.stages; ++j) {
    scratch_ = x0_ + step_.z.col(j);
    machine_->derivative(t0_ + scheme().c[j] * h, scratch_.data(), residual_.data());
    if (!is_small(in_tolerances(h * residual_))) return false;
    jumped = jumped || jumps(f0_, residual_);
  }
  if (!jumped) return false;
  ++statistics_.steps;
  h_ = h, smooth_ = false;
  stages_.renew_jacobian();
  return true;
}

void RadauSolver::note_not_finite(double h) {
  not_finite_within_ = h;
  choice_.forget_trend();
}

void RadauSolver::require_room(double h) {
  if (has_room(t0_, h, options_)) return;
  // The value that was not finite is looked for as far ahead as it was met.
  const double looks = not_finite_within_ / thresholds::ahead_steps;
  throw_step_too_small(*machine_, t0_, std::max(h, looks), x0_.data(), options_);
}

}  // namespace saltus::radau
