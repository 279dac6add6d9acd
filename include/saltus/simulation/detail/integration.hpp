// Integration: the continuous state between instants, and the solver that advances it.
#pragma once

#include <memory>
#include <string>

#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/options.hpp"
#include "saltus/simulation/results.hpp"
#include "saltus/solver/detail/choose.hpp"

namespace saltus {

/// Holds the solver of a run, made when a state moves for the first time. From then on the state of
/// the run is the solver's; before, and where no state moves, it is the machine's.
class Integration {
 public:
  /// Throws ModelError for a method that does not suit the plan.
  Integration(Machine& machine, GuardSet& guards, const SimulatorOptions& options);

  /// A run begins: no solver is at work.
  void begin();
  bool started() const noexcept { return started_; }
  /// Takes one minor step from t [s] to t_stop at most, and sets t to its end. Where no state moves
  /// and no guard can fire, t becomes t_stop.
  StopReason advance(double& t, double t_stop) {
    guards_->monitors.clear();
    if (still() && guards_->active().all.empty()) {
      t = t_stop, behind_ = true;
      return StopReason::stop_time;
    }
    if (!started_) start(t);
    if (behind_) restart(t, {});
    return delivered(t, solver_->advance(t_stop));
  }
  /// The same with a step that may be cut. If it reaches beyond `known` [s], it is cut there.
  StopReason advance_recallably(double& t, double t_stop, double known) {
    t_stop_ = t_stop;
    if (still() && guards_->active().all.empty()) return advance(t, t_stop);
    if (!started_) start(t);
    if (behind_) restart(t, {});
    records_ = guards_->all(), looks_ = guards_->g;
    const double end = solver_->look_ahead(t_stop);
    if (known < end - Calendar::slack(end)) return recall(t, known);
    return advance(t, t_stop);
  }
  /// Cuts the last step at `at` [s], if it reaches beyond and has no root before. Sets t to its end.
  StopReason cut(double& t, StopReason reason, double at) {
    if (reason == StopReason::root && t < at - Calendar::slack(at)) return reason;
    const double end = behind_ ? t : solver_->end_of_step();
    return at < end - Calendar::slack(end) ? recall(t, at) : reason;
  }
  /// After an instant that changed f or x: begins anew from the machine's state, if at work.
  void restart(double t, const Start& start) {
    if (started_) solver_->restart(t, machine_->x, start);
    behind_ = false;
  }

  /// Whether the solver has stepped beyond the present time, to a root of the step.
  bool inside_step() const { return started_ && !solver_->at_step_end(); }

  /// After a root a few roundings of the time before `stop`: goes on to the end of the step, if that is at
  /// `stop`. Returns whether it is.
  bool finish_step(double stop) { return solver_->finish_step(stop); }

  /// The present state.
  const Eigen::VectorXd& state() const { return started_ ? solver_->state() : machine_->x; }
  /// Copies the present state to the machine, and moves carried blocks onto their surfaces at t.
  void take_state(double t);
  /// The state at a time within the last step; a view that lasts until the next call of `at`.
  Eigen::VectorXd& at(double t) {
    interpolate(t, inside_.data());
    return inside_;
  }
  void interpolate(double t, double* x) { solver_->interpolate(t, x); }
  /// Degree in time of `interpolate`.
  int degree() const { return still() ? 0 : solver_->degree(); }
  /// [s] The time at which the first of the two polynomials of the last step ends; `from`, the
  /// begin of the step, if there is only one.
  double joint(double from) { return degree() == 0 ? from : solver_->joint(); }
  /// See Solver::stages.
  StepStages stages() { return still() ? StepStages() : solver_->stages(); }

  /// Writes counts, stretches and the method in use.
  void report(Statistics& statistics) const;
  /// The method and the linear solver in use, as lines of `Simulator::describe`.
  std::string describe() const;

 private:
  bool still() const { return machine_->plan().nx == 0; }
  StopReason delivered(double& t, StopReason reason) const {
    t = solver_->time();
    return reason;
  }
  /// A root before `to` is that of the whole step: its bits must not depend on what is known.
  StopReason recall(double& t, double to) {
    if (behind_) {
      t = to;
      return StopReason::stop_time;
    }
    restore_guards();
    if (const StopReason reason = solver_->recall(to); reason != StopReason::root)
      return delivered(t, reason);
    restore_guards();
    solver_->go_back();
    return advance(t, t_stop_);
  }
  void restore_guards() {
    guards_->restore(records_);
    guards_->g = looks_;
  }
  void make();
  void start(double t);

  Machine* machine_;
  GuardSet* guards_;
  const SimulatorOptions* options_;
  std::unique_ptr<Solver> solver_;
  bool started_ = false;
  bool behind_ = false;     // the solver is not at the present time: no guard could fire since
  Eigen::VectorXd inside_;  // a state inside the last step
  List<Guard> records_;     // of the guards before a step that may be recalled, and their values
  List<double> looks_;
  double t_stop_ = 0.0;  // [s] of that step
};

}  // namespace saltus
