// The stepper of the Radau methods: length and order of steps, looks inside them.
#include <utility>

#include "error_estimate.hpp"
#include "halves.hpp"
#include "saltus/solver/detail/radau.hpp"
#include "saltus/solver/detail/radau/damping.hpp"
#include "saltus/solver/detail/radau/step_choice.hpp"
#include "saltus/solver/detail/step_size.hpp"
#include "saltus/solver/detail/step_solver.hpp"
#include "stage_solver.hpp"

namespace saltus::radau {

namespace {

class RadauSolver final : public StepSolver<RadauSolver> {
 public:
  RadauSolver(Machine& machine, GuardSet& guards, const SolverOptions& options)
      : StepSolver(machine, guards, options),
        x0_(n_),
        f0_(n_),
        f1_(n_),
        residual_(n_),
        scratch_(n_),
        stages_(machine, options),
        step_(n_),
        last_(n_),
        inside_{Halves(n_)},
        error_(n_, options) {}

  void inside_step(double u, double* x) {
    if (!inside_.known) look_inside();
    if (inside_.halved)
      inside_.halves.read(x0_.data(), u / length_, x);
    else
      step_.read(x0_.data(), u / length_, x);
  }

  int degree() const override { return step_.stages; }
  double joint() override {
    if (!inside_.known) look_inside();
    return inside_.halved ? t0_ + 0.5 * length_ : -infinite;
  }
  std::string method() const override { return "radau"; }
  const SolverStatistics& statistics() const override {
    sum_ = statistics_;
    sum_.linear_setups = stages_.setups() - setups_before_;
    sum_.linear_solver = stages_.describe();
    return sum_;
  }

  /// See StepSolver. The root is off by the error of the dense output, and the cut ends ten times
  /// as far beyond it. Near the begin of the step the polynomial is as good as the state there.
  bool cut(double root) {
    const double moved = in_tolerances(x1_ - x0_);
    const double off = dense_error() / std::max(moved, std::numeric_limits<double>::min());
    const double h =
        root * (1.0 + std::clamp(tuning::beyond * off, tuning::least_beyond, tuning::most_beyond));
    if (!(h < length_ && root > tuning::near_begin * length_)) return false;
    std::swap(step_, last_);
    step_.stages = last_.stages;
    last_.predict(step_.stages, 0.0, h / length_, step_.z);
    if (!stages_.solve_aside(t0_, x0_, h, step_)) {
      std::swap(step_, last_);
      return false;
    }
    t1_ = t0_ + h;
    finish_stages(h);
    return true;
  }

 private:
  friend StepSolver<RadauSolver>;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  void begin(const Start& start) {
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
  void undo() {
    x1_ = x0_, t1_ = t0_;
    f1_known_ = false;
    forget_steps();
  }
  void forget_steps() {
    choice_.forget_trend(), stages_.distrust();
    smooth_ = false;
  }

  /// Tries steps until one is accepted.
  void step(double t_stop) {
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

  // The length of the next try of a step. The last try failed: Newton's iteration did not converge,
  // a value was not finite, or the error was too large.
  double retry_after_failure(double h) {
    ++statistics_.rejected;
    if (!stages_.finite()) note_not_finite(h);
    const double shorter = h * stages_.shorter();
    damping_.end();
    choice_.newton_failed();
    step_.stages = choice_.stages();
    error_.forget_tries();
    return shorter;
  }
  double retry_after_jump(double h) {
    ++statistics_.rejected;
    note_not_finite(h);
    return h * thresholds::blind_retry;
  }
  double retry_after_error(double error, double h, bool rejected, double t_stop) {
    ++statistics_.rejected;
    const double shorter = choice_.reject(error, h, stages_.convergence());
    // Behind a jump the steps before it say nothing, and the estimate of fast parts hardly shrinks
    // with h until it resolves them.
    if (smooth_ || rejected || damping_.goes_on()) return shorter;
    return std::min(shorter, careful_step(t_stop));
  }

  Scheme scheme() const { return scheme_of(step_.stages); }

  void prepare_step(double t_stop) {
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
  double careful_step(double t_stop) {
    return first_step(*machine_, t0_, x0_, f0_.data(), scratch_, residual_.data(), options_,
                      scheme().estimate_order(), t_stop);
  }

  /// The first values of the stages: the polynomial of the last step goes on.
  void predict(double h) {
    const double ratio = h / last_length_;
    if (smooth_ && ratio < tuning::furthest)
      last_.predict(step_.stages, 1.0, ratio, step_.z);
    else
      step_.z.leftCols(step_.stages).setZero();
  }

  /// Takes the step along the derivative if no state moves by a tolerance in it, and the derivative
  /// jumps: there Newton's iteration may not converge, however short the step is. Without steps a
  /// solution that slides along a jump would not be noticed.
  bool creep(double h) {
    for (int j = 0; j < step_.stages; ++j) step_.z.col(j) = scheme().c[j] * h * f0_;
    finish_stages(h);
    error_.set_size(in_tolerances(step_.end()));
    if (!(error_.size() <= tuning::small_move)) return false;
    machine_->derivative(t1_, x1_.data(), residual_.data());
    if (!((residual_ - f0_).norm() > tuning::large_turn * f0_.norm())) return false;
    ++statistics_.steps;
    h_ = h, smooth_ = false;
    stages_.renew_jacobian();
    return true;
  }

  /// The error of a step of length h, in allowed errors. A step that damps may have more.
  double judged(double h) {
    const double error = estimate(h);
    if (!damping_.by(h) || !std::isfinite(error)) return error;
    if (damping_.allows(error_.largest())) return std::min(error, 1.0);
    damping_.end();
    return error;
  }
  double estimate(double h) {
    finish_stages(h);
    return error_.look(stages_, {t0_, &x0_, &f0_, h}, step_, x1_);
  }
  /// Whether the derivative is finite at the end of the step, where Newton's iteration has not seen
  /// it. It is the derivative at the begin of the next step.
  bool ends_finite() {
    machine_->derivative(t1_, x1_.data(), f1_.data());
    f1_known_ = true;
    return f1_.allFinite();
  }
  void finish_stages(double h) {
    length_ = h;
    x1_ = x0_ + step_.end();
    inside_.known = inside_.halved = f1_known_ = false;
  }

  template <class Vector>
  double in_tolerances(const Vector& v) const {
    double sum = 0.0;
    for (Index i = 0; i < n_; ++i) {
      const double e = v[i] / options_.tolerance(i, std::max(std::abs(x0_[i]), std::abs(x1_[i])));
      sum += e * e;
    }
    return std::sqrt(sum / static_cast<double>(n_));
  }

  void accept(double error, double h, double wish, bool rejected) {
    ++statistics_.steps;
    const bool kept = stages_.keep();
    const double ratio = smooth_ ? h / last_length_ : 0.0;
    const double next = choice_.accept({h, error, ratio, rejected, kept}, stages_.convergence());
    if (damping_.goes_on()) return go_on_damping(h);
    h_ = next;
    if (!rejected && h < wish)
      h_ = std::max(h_, wish);  // the stop time shortened it, not the error
    smooth_ = true;
  }

  /// The next step damps the oscillation further, or is free.
  void go_on_damping(double h) {
    if (damping_.by(h)) damping_.accept(error_.largest());
    h_ = damping_.length(), smooth_ = true;
    choice_.forget_trend();
  }

  /// [tolerances] Of the collocation polynomial inside the step.
  double dense_error() const { return error_.size() * scheme().dense_share; }
  void look_inside() {
    inside_.known = true;
    inside_.halved = dense_error() > thresholds::dense_room &&
                     inside_.halves.solve(stages_, t0_, x0_, x1_, length_, step_);
  }

  /// The lengths of the next steps are no trend of the error.
  void note_not_finite(double h) {
    not_finite_within_ = h;
    choice_.forget_trend();
  }

  void require_room(double h) {
    if (has_room(t0_, h, options_)) return;
    // The value that was not finite is looked for as far ahead as it was met.
    const double looks = not_finite_within_ / thresholds::ahead_steps;
    throw_step_too_small(*machine_, t0_, std::max(h, looks), x0_.data(), options_);
  }

  Eigen::VectorXd x0_, f0_;  // at the begin of the step
  Eigen::VectorXd f1_;       // at its end
  Eigen::VectorXd residual_, scratch_;
  StageSolver stages_;
  StagePolynomial step_, last_;  // of the present step, and of the step before
  /// The looks inside the step: by its polynomial, or by those of two halves.
  struct Inside {
    Halves halves;
    bool known = false, halved = false;
  } inside_;
  ErrorEstimate error_;
  bool f1_known_ = false;
  Damping damping_;
  bool smooth_ = false;  // the solution of the last step continues in the present one
  double h_ = 0.0, horizon_ = infinite, last_length_ = 0.0;
  double not_finite_within_ = 0.0;  // [s] of the present step; 0: all values were finite
  StepChoice choice_{options_.rtol};
  long setups_before_ = 0;  // of earlier runs
  mutable SolverStatistics sum_;
};

}  // namespace

}  // namespace saltus::radau

namespace saltus {

std::unique_ptr<Solver> make_radau(Machine& machine, GuardSet& guards,
                                   const SolverOptions& options) {
  return std::make_unique<radau::RadauSolver>(machine, guards, options);
}

}  // namespace saltus
