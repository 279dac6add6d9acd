// AutoSolver: an explicit method while the scene is not stiff, Radau or BDF while it is.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "saltus/solver/detail/return_test.hpp"
#include "saltus/solver/detail/stiff_methods.hpp"
#include "saltus/solver/detail/stiff_signs.hpp"
#include "saltus/solver/detail/stretch_log.hpp"

namespace saltus {

/// Starts with the explicit method. When the scene looks stiff, a stiff method continues from the
/// present point: see StiffSigns and choose_stiff_method. The explicit method returns when the
/// steps of the stiff method are stable for it: see ReturnTest. This is checked when a stiff
/// stretch is restarted too. All methods share the guard records, so no guard is armed anew.
class AutoSolver final : public Solver {
 public:
  AutoSolver(Machine& machine, GuardSet& guards, const SolverOptions& options,
             std::unique_ptr<OneStepSolver> one_step)
      : explicit_(std::move(one_step)),
        methods_(machine, guards, options),
        radius_(machine, options),
        signs_(*explicit_, radius_),
        damps_(options.rtol > thresholds::tight_for_damping) {}

  void restart(double t, const Eigen::VectorXd& x, const Start& start) override {
    Start how = start;
    if (start.first)
      begin_run(t);
    else
      how.changed = changes_at_event(t, x);
    signs_.restart(start.first ? 0.0 : test_.longest());
    test_.forget();
    active().restart(t, x, how);
  }

  StopReason advance(double t_stop) override {
    if (active().at_step_end()) choose();
    const double from = active().time();
    const StopReason reason = step(t_stop);
    test_.add_step(active().time() - from);
    return reason;
  }

  double look_ahead(double t_stop) override {
    if (active().at_step_end()) choose();
    from_ = active().time(), test_before_ = test_;
    return active().look_ahead(t_stop);
  }
  StopReason recall(double t) override {
    test_ = test_before_;
    const StopReason reason = active().recall(t);
    test_.add_step(active().time() - from_);
    return reason;
  }
  double end_of_step() const override { return active().end_of_step(); }
  void go_back() override {
    test_ = test_before_;
    active().go_back();
  }

  void interpolate(double t, double* x) override { active().interpolate(t, x); }
  int degree() const override { return active().degree(); }
  double joint() override { return active().joint(); }
  StepStages stages() override { return active().stages(); }
  double time() const override { return active().time(); }
  const Eigen::VectorXd& state() const override { return active().state(); }
  bool at_step_end() const override { return active().at_step_end(); }
  bool finish_step(double t_stop) override { return active().finish_step(t_stop); }

  const SolverStatistics& statistics() const override {
    sum_ = explicit_->statistics();
    for (const Solver* each : {methods_.radau(), methods_.bdf()}) {
      if (each == nullptr) continue;
      const SolverStatistics& more = each->statistics();
      sum_.steps += more.steps, sum_.rejected += more.rejected;
      sum_.restarts += more.restarts, sum_.linear_setups += more.linear_setups;
      if (sum_.linear_solver.empty() || each == stiff_) sum_.linear_solver = more.linear_solver;
    }
    return sum_;
  }

  std::vector<Stretch> stretches() const override { return log_.all(active()); }
  std::string method() const override { return log_.to_string(active()); }

 private:
  Solver& active() { return stiff_ ? *stiff_ : static_cast<Solver&>(*explicit_); }
  const Solver& active() const { return stiff_ ? *stiff_ : static_cast<const Solver&>(*explicit_); }
  bool in_bdf() const { return stiff_ != nullptr && stiff_ == methods_.bdf(); }
  const CheckPace& pace() const { return in_bdf() ? pace_of_bdf : pace_of_radau; }

  void begin_run(double t) {
    stiff_ = nullptr, part_ = {};
    methods_.begin_run(), radius_.forget(), test_.begin_run(), log_.clear(t);
  }

  /// Takes a step. Where Radau's matrices have turned out to be impossible, another method takes
  /// it.
  StopReason step(double t_stop) {
    try {
      return active().advance(t_stop);
    } catch (const NoFactors&) {
      methods_.refuse_radau();
      const bool found = accepts(part_);
      hand_over(found ? chosen_ : nullptr, why_, start_of(false));
      return active().advance(t_stop);
    }
  }

  /// Changes to another method at the end of a step, if a change is due.
  void choose() {
    if (stiff_) {
      if (!not_stiff_again()) return;
      signs_.be_patient(part_);
      hand_over(nullptr, "", start_of(false));
    } else if (signs_.look(test_.longest(), [&](const FastPart& part) { return accepts(part); })) {
      if (test_.steps() < thresholds::short_stretch && log_.changed()) test_.be_patient();
      hand_over(chosen_, why_, start_of(true));
    }
  }
  bool not_stiff_again() {
    return test_.due(pace()) && test_.passes(radius_(active().time(), active().state()), pace());
  }
  /// Changes to another method between two stretches, at (t, x), if a change is due. Returns
  /// whether.
  bool changes_at_event(double t, const Eigen::VectorXd& x) {
    if (!stiff_) return false;
    if (radius_(t, x) * test_.longest() < pace().reach) return change(t, nullptr, ""), true;
    if (!in_bdf() || !methods_.count_event(test_.steps())) return false;
    Solver* chosen = methods_.choose(t, x, part_.hardly_damped, why_);
    if (chosen == nullptr || chosen == stiff_) return false;
    return change(t, chosen, why_), true;
  }
  /// Chooses the stiff method for a scene with this fast part. Returns whether there is one.
  bool accepts(const FastPart& part) {
    part_ = part;
    chosen_ = methods_.choose(active().time(), active().state(), part.hardly_damped, why_);
    return chosen_ != nullptr;
  }

  /// A fast oscillation that is as small as the errors of the explicit method is one of them, and
  /// the stiff method damps it. A larger one may be the solution. At tight tolerances the steps
  /// that damp it are too long for the solution, and the errors of dop853 are small there.
  Start start_of(bool stiff) const {
    Start start{.changed = true, .handover = true};
    if (!stiff || !part_.hardly_damped || !damps_) return start;
    const double size = signs_.amplitude(part_);
    if (size <= thresholds::damped_size) start.damp_rate = part_.rate, start.damp_size = size;
    return start;
  }

  /// The next method continues from the end of the last step.
  void hand_over(Solver* stiff, const char* why, const Start& start) {
    const double t = active().time();
    handed_over_ = active().state();
    change(t, stiff, why);
    test_.forget(), signs_.restart(0.0);
    active().restart(t, handed_over_, start);
  }
  void change(double t, Solver* stiff, const char* why) {
    log_.end(active(), t);
    stiff_ = stiff;
    log_.begin(active(), why);
  }

  std::unique_ptr<OneStepSolver> explicit_;
  StiffMethods methods_;
  Solver* stiff_ = nullptr;   // the stiff method in use; null: the explicit one
  Solver* chosen_ = nullptr;  // the stiff method that suits,
  const char* why_ = "";      // and why
  FastPart part_;             // for which it was chosen
  SpectralRadius radius_;
  StiffSigns signs_;
  ReturnTest test_;              // of the steps since the last restart or change
  bool damps_;                   // see start_of
  ReturnTest test_before_;       // before the step of the last look_ahead,
  double from_ = 0.0;            // which begins here [s]
  Eigen::VectorXd handed_over_;  // the state at a change
  StretchLog log_;
  mutable SolverStatistics sum_;
};

}  // namespace saltus
