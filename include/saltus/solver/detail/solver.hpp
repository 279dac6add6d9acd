// Solver: the interface of a method that advances xdot = f(t, x) between instants.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/solver/detail/column_steps.hpp"
#include "saltus/solver/detail/guard_set.hpp"
#include "saltus/solver/linear_solver.hpp"
#include "saltus/solver/statistics.hpp"

namespace saltus {

enum class StopReason {
  step,       ///< one accepted minor step, nothing else
  stop_time,  ///< exactly the requested time
  root        ///< a guard fired: see GuardSet::fired_at_root
};

/// The settings of a solver.
struct SolverOptions {
  double rtol = 1e-6;  ///< the smallest, if each state has its own
  double atol = 1e-8;
  double min_step = 0.0;                                      ///< [s]
  double max_step = std::numeric_limits<double>::infinity();  ///< [s]
  LinearSolver linear_solver = LinearSolver::automatic;       ///< of BDF and Radau
  bool find_sparsity = true;                                  ///< see Probe
  double first_step = 0.0;                                    ///< [s] 0: chosen by the tolerance
  std::vector<double> rtols = {}, atols = {};                 ///< of each state; empty: one for all

  const double* each_rtol() const { return rtols.empty() ? nullptr : rtols.data(); }
  const double* each_atol() const { return atols.empty() ? nullptr : atols.data(); }
  /// The error of state i that counts as one, where the state has this size.
  double tolerance(Index i, double size) const {
    if (rtols.empty()) return atol + rtol * size;
    return nth(atols, i) + nth(rtols, i) * size;
  }
};

/// How a stretch begins.
struct Start {
  double horizon = std::numeric_limits<double>::infinity();  ///< [s] within which an event may
                                                             ///< follow: resolve it
  const Eigen::VectorXd* flow = nullptr;  ///< f(t, x), if the engine knows it already
  bool first = false;                     ///< a new run: step size and counts are reset too
  bool changed = false;                   ///< another method took the steps before
  bool handover = false;   ///< a change of method within a stretch: it does not count as a restart
  double damp_rate = 0.0;  ///< |lambda| [1/s] of a fast oscillation that the errors of the method
                           ///< before have excited, for the first steps to damp; 0: there is none
  double damp_size = 0.0;  ///< [tolerances] its amplitude
};

/// Advances the continuous state of a machine. Between two calls of `restart` the machine's
/// discrete values do not change, so f and the guards are smooth. Throws SimulationError if no step
/// can be taken. Exceptions of a user's function pass through unchanged.
class Solver {
 public:
  virtual ~Solver() = default;

  /// Forgets the history and begins at (t, x).
  virtual void restart(double t, const Eigen::VectorXd& x, const Start& start) = 0;
  /// Takes one minor step, at most to t_stop, or to the first root in it.
  virtual StopReason advance(double t_stop) = 0;
  // --- for a step that may be cut at a time that becomes known later

  /// Takes the step that `advance` would take, and delivers nothing of it. Returns its end [s], or
  /// -infinity where only `advance` can tell. To be called before each `advance` that may be recalled.
  virtual double look_ahead(double t_stop) = 0;
  /// Delivers the step of the last `look_ahead` up to t [s], or to a root before, whatever `advance`
  /// has delivered since. The guards are those at the time of that call.
  virtual StopReason recall(double t) = 0;
  /// Nothing of that step is delivered any more; `advance` delivers it.
  virtual void go_back() = 0;
  /// [s] The end of the last step that was taken, also where it is not delivered yet.
  virtual double end_of_step() const = 0;
  /// The state at a time within the last step.
  virtual void interpolate(double t, double* x) = 0;
  /// Degree in time of `interpolate` within the last step.
  virtual int degree() const = 0;
  /// The time [s] within the last step at which one polynomial ends and the next begins; a time
  /// before the step if there is only one.
  virtual double joint() { return -std::numeric_limits<double>::infinity(); }
  virtual const SolverStatistics& statistics() const = 0;

  /// Which method was used when, in order of time.
  virtual std::vector<Stretch> stretches() const = 0;

  virtual double time() const = 0;
  virtual const Eigen::VectorXd& state() const = 0;
  /// False if a root stopped the last step inside, and the rest of it is not delivered yet.
  virtual bool at_step_end() const = 0;
  /// After a root inside the last step: delivers the rest of the step, which has not been searched, if it
  /// ends at t_stop. False if it ends elsewhere: then nothing has changed.
  virtual bool finish_step(double t_stop) = 0;
  /// Method in use now, for the statistics.
  virtual std::string method() const = 0;
  /// The stages of the last step, if an explicit method has taken it and still has them. A call of
  /// `interpolate` inside the step adds the stages that only the dense output reads.
  virtual StepStages stages() { return {}; }
};

}  // namespace saltus
