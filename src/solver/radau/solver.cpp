// Steps of the Radau methods: begin, first values, acceptance.
#include "solver.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "saltus/solver/detail/radau.hpp"
#include "saltus/solver/detail/step_size.hpp"

namespace saltus::radau {

RadauSolver::RadauSolver(Machine& machine, GuardSet& guards, const SolverOptions& options)
    : StepSolver(machine, guards, options),
      x0_(n_),
      f0_(n_),
      f1_(n_),
      residual_(n_),
      scratch_(n_),
      stages_(machine, options),
      step_(n_),
      last_(n_),
      inside_{StageHalves(n_)},
      error_(n_, options) {}

const SolverStatistics& RadauSolver::statistics() const {
  sum_ = statistics_;
  sum_.linear_setups = stages_.setups() - setups_before_;
  sum_.linear_solver = stages_.describe();
  return sum_;
}

void RadauSolver::begin(const Start& start) {
  if (start.first || start.changed) {
    h_ = start.first ? options_.first_step : 0.0;
    choice_.start();
    stages_.renew_jacobian();
    if (start.first) stages_.forget(), setups_before_ = stages_.setups();
  }
  damping_.begin(start.damp_rate, start.damp_size, options_.max_step);
  if (damping_.goes_on()) h_ = damping_.length();
  f1_known_ = start.flow != nullptr;
  if (f1_known_) f1_ = *start.flow;
  horizon_ = start.horizon;
  choice_.restart();
  if (damping_.goes_on()) choice_.take(3);
  forget_steps();
}

void RadauSolver::undo() {
  x1_ = x0_, t1_ = t0_;
  f1_known_ = false;
  forget_steps();
}

void RadauSolver::forget_steps() {
  error_.forget_steps();
  choice_.forget_trend(), stages_.jump();
  smooth_ = false;
}

void RadauSolver::step(double t_stop) {
  prepare_step(t_stop);
  double wish = std::min({h_, options_.max_step, std::exchange(horizon_, infinite)});
  const double left = t_stop - t0_;
  for (bool rejected = false;; rejected = true) {
    const auto [h, ends] = fit(wish, left);
    if (!ends) require_room(h);
    t1_ = ends ? t_stop : t0_ + h;
    if (!stages_.solve({t0_, &x0_, &f0_, h}, step_, [&, h = h] { predict(h); })) {
      if (creep(h)) return;
      wish = retry_after_failure(h);
      continue;
    }
    const double error = judged(h);
    if (error <= 1.0 && ends_finite()) return accept(error, h, wish, rejected);
    wish = error <= 1.0 ? retry_after_jump(h) : retry_after_error(error, h, rejected, t_stop);
  }
}

void RadauSolver::prepare_step(double t_stop) {
  x0_.swap(x1_);
  not_finite_within_ = 0.0;
  error_.forget_tries();
  last_length_ = length_;
  std::swap(step_, last_);
  step_.stages = choice_.stages();
  f0_.swap(f1_);
  if (!std::exchange(f1_known_, false)) machine_->derivative(t0_, x0_.data(), f0_.data());
  if (!f0_.allFinite()) throw_not_finite(*machine_, t0_, x0_.data());
  stages_.prepare(t0_, x0_);
  if (h_ == 0.0) h_ = careful_step(t_stop);
  h_ = std::max(h_, options_.min_step);  // the first step is only a guess
}

double RadauSolver::careful_step(double t_stop) {
  return first_step(*machine_, t0_, x0_, f0_.data(), scratch_, residual_.data(), options_,
                    scheme().estimate_order(), t_stop);
}

void RadauSolver::predict(double h) {
  const double ratio = h / last_length_;
  if (smooth_ && ratio < tuning::furthest)
    last_.predict(step_.stages, 1.0, ratio, step_.z);
  else
    step_.z.leftCols(step_.stages).setZero();
}

void RadauSolver::finish_stages(double h) {
  length_ = h;
  x1_ = x0_ + step_.end();
  inside_.known = inside_.halved = f1_known_ = false;
}

void RadauSolver::accept(double error, double h, double wish, bool rejected) {
  ++statistics_.steps;
  error_.accept(h, step_.stages);
  const bool kept = stages_.keep(h);
  const double ratio = smooth_ ? h / last_length_ : 0.0;
  const double next = choice_.accept({h, error, ratio, rejected, kept}, stages_.convergence());
  if (damping_.goes_on()) return go_on_damping(h);
  h_ = next;
  if (!rejected && h < wish) h_ = std::max(h_, wish);  // the stop time shortened it, not the error
  smooth_ = true;
}

void RadauSolver::go_on_damping(double h) {
  if (damping_.by(h)) damping_.accept(error_.largest());
  h_ = damping_.length(), smooth_ = true;
  choice_.forget_trend();
}

}  // namespace saltus::radau

namespace saltus {

std::unique_ptr<Solver> make_radau(Machine& machine, GuardSet& guards,
                                   const SolverOptions& options) {
  return std::make_unique<radau::RadauSolver>(machine, guards, options);
}

}  // namespace saltus
