// AutoSolver: a one-step method while the scene is not stiff, BDF while it is.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "saltus/solver/detail/cvode.hpp"
#include "saltus/solver/detail/one_step.hpp"
#include "saltus/solver/detail/spectral_radius.hpp"
#include "saltus/solver/detail/stretch_log.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Starts with the explicit method. When the scene looks stiff, BDF continues from the present
/// point. The explicit method returns when |lambda| h < 1 for the steps h of BDF, because these
/// steps are stable for it (L. Petzold, SIAM J. Sci. Stat. Comput. 4 (1983) 136). This is checked
/// when a stretch of BDF is restarted, and every fifty steps of BDF. The latter check has to
/// succeed several times in a row: twice at first, and twice as often after each return that did
/// not last, so that the methods do not alternate. Both methods share the guard records, so no
/// guard is armed anew. CVODE is made when it is first needed.
class AutoSolver final : public Solver {
 public:
  AutoSolver(Machine& machine, GuardSet& guards, const SolverOptions& options,
             std::unique_ptr<OneStepSolver> one_step)
      : machine_(&machine),
        guards_(&guards),
        options_(options),
        explicit_(std::move(one_step)),
        radius_(machine, options) {
    explicit_->watch_stiffness();
  }

  void restart(double t, const Eigen::VectorXd& x, const Start& start) override {
    if (start.first) begin_run(t);
    if (stiff_ && radius_(t, x) * longest() < thresholds::stable_reach) change(t, false);
    before_ = start.first ? 0.0 : longest();
    forget_steps();
    now().restart(t, x, start);
  }

  StopReason advance(double t_stop) override {
    if (now_at_step_end()) choose();
    const double from = now().time();
    const StopReason reason = now().advance(t_stop);
    longest_ = std::max(longest_, now().time() - from);
    ++steps_;
    return reason;
  }

  void interpolate(double t, double* x) override { now().interpolate(t, x); }
  int degree() const override { return now().degree(); }
  double joint() override { return now().joint(); }
  double time() const override { return now().time(); }
  const Eigen::VectorXd& state() const override { return now().state(); }
  bool at_step_end() const override { return now().at_step_end(); }

  const SolverStatistics& statistics() const override {
    sum_ = explicit_->statistics();
    for (const auto& each : bdf_) {
      if (!each) continue;
      const SolverStatistics& more = each->statistics();
      sum_.steps += more.steps, sum_.rejected += more.rejected;
      sum_.restarts += more.restarts, sum_.linear_setups += more.linear_setups;
      sum_.linear_solver = more.linear_solver;
    }
    return sum_;
  }

  std::vector<Stretch> stretches() const override { return log_.all(now()); }
  std::string method() const override { return log_.to_string(now()); }

 private:
  /// The damping ratio up to which a part oscillates: its bound by stability is nearer to that of
  /// the imaginary axis (dopri5: 1.0, 1.4, 1.9, 2.7, 3.2 at ratios 0, 0.001, 0.01, 0.1, 0.3).
  static constexpr double swings = 0.3;
  /// The forms of BDF. Order 3 is stable from 4 degrees off the imaginary axis, order 2 on it
  /// (Hairer, Wanner II, p. 251, (2.7)): from a damping ratio of 0.07.
  static constexpr std::array highest_order{5, 3, 2};
  static constexpr double damped_for_order_3 = 0.07;
  static constexpr double tightest_for_order_2 = 1e-7;
  static constexpr double beyond_instability = 30.0;  // h |lambda|
  static constexpr double rounding = 1e-3;            ///< of a damping ratio by differences

  Solver& now() { return stiff_ ? *bdf_[form_] : static_cast<Solver&>(*explicit_); }
  const Solver& now() const {
    return stiff_ ? static_cast<const Solver&>(*bdf_[form_]) : *explicit_;
  }
  bool now_at_step_end() const { return now().at_step_end(); }

  void begin_run(double t) {
    stiff_ = false, bdf_ = {}, form_ = 0, beyond_ = beyond_instability, radius_.forget();
    log_.clear(t);
    longest_ = window_ = 0.0, patience_ = thresholds::first_checks;
  }
  void forget_steps() { longest_ = window_ = 0.0, steps_ = not_stiff_ = 0, unchecked_ = true; }
  double longest() const { return std::max(longest_, window_); }

  /// Changes to the other method at the end of a step, if a change is due.
  void choose() {
    const bool stiff = stiff_ ? !not_stiff_again() : looks_stiff() || oscillates_beside();
    if (stiff == stiff_) return;
    const double t = now().time();
    handed_over_ = now().state();
    if (stiff && steps_ < thresholds::short_stretch && log_.changed())
      patience_ = std::min(2 * patience_, thresholds::most_checks);
    const bool in_vain = stiff_ && hardly_damped_;
    change(t, stiff);
    forget_steps(), before_ = 0.0;
    now().restart(t, handed_over_, {.handover = true});
    if (in_vain) explicit_->stiffness().put_off(4), beyond_ *= 4.0;
  }

  bool looks_stiff() {
    StiffnessTest& test = explicit_->stiffness();
    if (test.detected()) {
      const double rate = radius_(explicit_->time(), explicit_->state());
      const bool sure = radius_.damping() > swings || test.by_smoothness() || test.oscillates(rate);
      if (sure && choose_form(rate)) return true;
      test.forget(false);
    }
    form_ = 0, hardly_damped_ = false;
    return collapsed();
  }

  /// Whether stability makes the first step after a restart a hundred times shorter than the steps
  /// before. Then the scene is stiff, without a wait for fifteen such steps. A fast part that
  /// oscillates was set going by what restarted it (a contact): it is the solution, and the error
  /// bounds its steps.
  bool collapsed() {
    if (!unchecked_ || steps_ == 0) return false;
    unchecked_ = false;
    if (!(longest_ < thresholds::collapse * before_)) return false;
    const double radius = radius_(explicit_->time(), explicit_->state());
    return radius_.damping() > 0.9 &&
           radius * before_ > thresholds::far_beyond_stability * explicit_->stability() &&
           radius * longest_ > thresholds::least_reach;
  }

  /// Whether stability bounds the steps beside a fast oscillation that is hardly damped. An
  /// oscillation that grows does not count, because BDF would damp it.
  bool oscillates_beside() {
    StiffnessTest& test = explicit_->stiffness();
    if (!test.may_oscillate()) return false;
    const double rate = radius_(explicit_->time(), explicit_->state());
    const bool beside = radius_.damping() > -rounding && radius_.damping() <= swings;
    if (beside && test.oscillates(rate) && choose_form(rate)) return true;
    test.put_off(2);
    return false;
  }

  /// Chooses the form of BDF that is stable for a part of this rate; false if there is none. At a
  /// tight tolerance order 2 takes too many steps, and the explicit method hardly excites the part:
  /// only steps of order 5 that are beyond its instability, h |lambda| up to 5, are tried.
  bool choose_form(double rate) {
    const double damping = radius_.damping();
    const bool beyond = rate * explicit_->stiffness().step_of_bdf() > beyond_;
    hardly_damped_ = damping <= swings;
    form_ = damping > swings ? 0 : damping > damped_for_order_3 ? 1 : 2;
    if (form_ == 2 && options_.rtol < tightest_for_order_2) form_ = 0;
    return form_ != 0 || damping > swings || beyond;
  }

  /// Whether the scene is not stiff any more. It is checked every fifty steps of BDF, except after
  /// the first fifty, in which the order and the steps still rise.
  bool not_stiff_again() {
    if (steps_ == 0 || steps_ % thresholds::check_every != 0) return false;
    window_ = std::exchange(longest_, 0.0);
    if (steps_ < thresholds::short_stretch) return false;
    not_stiff_ = radius_(now().time(), now().state()) * window_ < thresholds::stable_reach
                     ? not_stiff_ + 1
                     : 0;
    // Low orders need some hundred steps to damp what the errors have made of a fast oscillation.
    return not_stiff_ >= (form_ != 0 ? std::max(patience_, 8) : patience_);
  }

  void change(double t, bool stiff) {
    if (stiff && !bdf_[form_]) {
      SolverOptions options = options_;
      options.highest_order = highest_order[form_];
      options.tightens = false;  // the choice is fitted to CVODE's own steps
      bdf_[form_] = make_cvode(*machine_, *guards_, options, CvodeMethod::bdf);
    }
    log_.end(now(), t);
    stiff_ = stiff;
    log_.begin(now());
  }

  Machine* machine_;
  GuardSet* guards_;
  SolverOptions options_;
  std::unique_ptr<OneStepSolver> explicit_;
  std::array<std::unique_ptr<Solver>, 3> bdf_;  // in the forms of highest_order
  std::size_t form_ = 0;
  bool hardly_damped_ = false;  // the part for which the form was chosen
  double beyond_ = beyond_instability;
  SpectralRadius radius_;
  bool stiff_ = false;
  double longest_ = 0.0;   // [s] longest step since the last restart, change of method or check
  double window_ = 0.0;    // [s] longest of the fifty steps before the last check
  double before_ = 0.0;    // [s] longest step before the last restart
  bool unchecked_ = true;  // no step was checked since the last restart or change
  int steps_ = 0;          // since the last restart or change
  int not_stiff_ = 0, patience_ = thresholds::first_checks;
  Eigen::VectorXd handed_over_;  // the state at a change
  StretchLog log_;
  mutable SolverStatistics sum_;
};

}  // namespace saltus
