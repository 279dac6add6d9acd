// The seam: what the engine asks of a method that advances xdot = f(t, x) between instants.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/solver/detail/linear_solver.hpp"
#include "saltus/solver/detail/watch.hpp"
#include "saltus/solver/statistics.hpp"

namespace saltus {

enum class StopReason {
  step,       ///< one accepted minor step, nothing else
  stop_time,  ///< exactly the time that was asked for
  root        ///< a guard fired: see Watch::fired
};

/// What a solver needs to know beyond the scene.
struct SolverOptions {
  double rtol = 1e-6;
  double atol = 1e-8;
  double min_step = 0.0;                                      ///< [s]
  double max_step = std::numeric_limits<double>::infinity();  ///< [s]
  LinearSolver linear_solver = LinearSolver::automatic;       ///< of BDF
  bool find_sparsity = true;                                  ///< see Probe
};

/// How a stretch begins.
struct Start {
  double horizon = std::numeric_limits<double>::infinity();  ///< [s] within which an event may
                                                             ///< follow: resolve it
  const Eigen::VectorXd* flow = nullptr;  ///< f(t, x), where the engine had to ask for it anyway
  bool first = false;                     ///< a new run: step size and counts are forgotten too
  bool handover = false;  ///< another method was at work: no restart of the scene, and none counted
};

/// Advances the continuous state of a machine. Between two calls of `restart` the machine's
/// discrete values do not change, so f and the guards are smooth. Throws SimulationError where no
/// step can be taken, and whatever a user's function threw, as it was thrown.
class Solver {
 public:
  virtual ~Solver() = default;

  /// Forgets the history and begins at (t, x).
  virtual void restart(double t, const Eigen::VectorXd& x, const Start& start) = 0;
  /// One minor step, not past t_stop, or to the first root in it.
  virtual StopReason advance(double t_stop) = 0;
  /// The state at a time within the last step.
  virtual void interpolate(double t, double* x) = 0;
  /// Degree in time of what it says within the last step.
  virtual int degree() const = 0;
  /// The time [s] within the last step where that goes over from one polynomial to the next; before
  /// the step where there is but one.
  virtual double joint() { return -std::numeric_limits<double>::infinity(); }
  /// The guards that fired, after StopReason::root.
  virtual const std::vector<Firing>& roots() const = 0;
  virtual const SolverStatistics& statistics() const = 0;

  /// Which method was used when, in order of time.
  virtual std::vector<Stretch> stretches() const = 0;

  virtual double time() const = 0;
  virtual const Eigen::VectorXd& state() const = 0;
  /// False if a root stopped the last step inside and the rest of it is still to be delivered.
  virtual bool at_step_end() const = 0;
  /// Method in use now, for the statistics.
  virtual std::string method() const = 0;
};

}  // namespace saltus
