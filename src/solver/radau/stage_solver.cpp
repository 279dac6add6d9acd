// When a Jacobian and a factorisation are made anew.
#include "stage_solver.hpp"

#include <utility>

#include "saltus/solver/detail/linear_thresholds.hpp"
#include "saltus/solver/detail/radau.hpp"
#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

void StageSolver::prepare(double t, const Eigen::VectorXd& x) {
  if (structure_) return;
  structure_.emplace(*machine_, options_, t, x.data());
  use_structure(t);
}

void StageSolver::use_structure(double t) {
  if (!structure_->direct()) {
    const std::string found = structure_->describe();
    structure_.reset();
    throw NoFactors(
        text("t = ", t,
             " s: ode_solver_method 'radau' factorises its matrices, and those of this "
             "scene would fill up (",
             found,
             "); take 'bdf', declare the sparsity of the largest block, or set linear_solver to "
             "'sparse', 'band' or 'dense'"),
        t, "");
  }
  systems_.emplace(*structure_), aside_.emplace(*structure_);
  jacobian_.assign(structure_->layout().size, 0.0);
  known_ = false;
}

/// False if the derivative nearby is not finite.
bool StageSolver::make_jacobian(const Step& step) {
  const double *x = step.x->data(), *f = step.f->data();
  const Increments by = structure_->increments(step.h);
  for (;;) {
    if (!structure_->jacobian()(step.t, x, f, by, jacobian_.data())) return false;
    if (!structure_->misses_places(step.t, x, f, by, jacobian_.data())) break;
    structure_->renew(false);
    use_structure(step.t);
  }
  systems_->forget(), aside_->forget();
  known_ = true, age_ = 0;
  return true;
}

bool StageSolver::serves_after_jump(const Step& step) {
  if (machine_->plan().nx <= thresholds::fresh_jacobian) return false;
  Increments by = structure_->increments(step.h);
  by.h = infinite;  // steps of any length will use it
  return structure_->jacobian().explains(step.t, step.x->data(), step.f->data(), by,
                                         jacobian_.data());
}

/// False if a matrix is singular.
bool StageSolver::set_up(StageSystems& systems, const Scheme& scheme, double h) {
  ++setups_;
  return systems.factor(jacobian_, scheme, h);
}

bool StageSolver::doubt(const Step& step) {
  failed_ = true;
  if (++doubts_ < tuning::most_doubts || !newton_.finite()) return false;
  doubts_ = 0;
  Jacobian& jacobian = structure_->jacobian();
  const Increments by = structure_->increments(step.h);
  if (!jacobian.trusts_own() ||
      jacobian.explains(step.t, step.x->data(), step.f->data(), by, jacobian_.data()))
    return false;
  jacobian.distrust();
  return true;
}

bool StageSolver::recover(Verdict verdict, const Step& step) {
  if (age_ > 0 || doubt(step)) {
    known_ = false;
    return true;
  }
  if (structure_->renew(true)) {
    use_structure(step.t);
    return true;
  }
  if (verdict == Verdict::slow) shorter_ = newton_.convergence().shorter();
  if (!newton_.finite()) shorter_ = thresholds::blind_retry;
  return false;
}

bool StageSolver::keep(double h) {
  const Convergence& newton = convergence();
  factor_ = newton.at_rounding() ? infinite : newton.factor();  // roundings tell no contraction
  length_ = h;
  ++age_;
  if (!std::exchange(failed_, false)) doubts_ = std::max(doubts_ - 1, 0);
  const bool old = machine_->plan().nx <= thresholds::fresh_jacobian && age_ >= tuning::oldest;
  known_ = known_ && newton.keeps_jacobian() && !old;
  return known_;
}

bool StageSolver::solve_aside(double t, const Eigen::VectorXd& x, double h,
                              StagePolynomial& stages) {
  const Scheme scheme = scheme_of(stages.stages);
  if (!aside_->serves(scheme, h) && !set_up(*aside_, scheme, h)) return false;
  return newton_.solve({t, h, x.data(), room(), infinite}, *aside_, stages) == Verdict::converged;
}

}  // namespace saltus::radau
