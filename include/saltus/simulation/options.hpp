// SimulatorOptions: the options of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saltus/plan/refinement.hpp"
#include "saltus/solver/linear_solver.hpp"
#include "saltus/solver/method.hpp"
#include "saltus/solver/tolerance.hpp"

namespace saltus {

inline constexpr double default_zeno_tolerance = 1e-6;  ///< [s]

struct SimulatorOptions {
  /// Relative and absolute tolerance of a minor step: the root mean square over the states of
  /// error / (atol + rtol |x|) stays below 1. Each is one number for all states, or one for each
  /// continuous state of the system, in the order of the context.
  Tolerance rtol = 1e-6;
  Tolerance atol = 1e-8;

  /// The method that advances the states: `automatic` takes dopri5 or dop853 by tolerance, and bdf
  /// while the scene is stiff. A name is converted by method_from("bdf").
  Method ode_solver_method = Method::automatic;

  /// The solver of a stiff method's linear systems; `automatic` chooses by the number of states and
  /// entries of the Jacobian. The statistics say which was chosen, and why. A name is converted by
  /// linear_solver_from("band").
  LinearSolver linear_solver = LinearSolver::automatic;
  /// If a block of more than 256 states declares neither Jacobian nor sparsity, a stiff method
  /// finds the sparsity by calls of its derivative near the state. The statistics say what was
  /// found. False: such a block counts as full, or its entries as unknown.
  bool find_sparsity = true;

  /// The number of instants a run may have; more end it with the status step_limit. Empty: no
  /// limit.
  std::optional<std::int64_t> max_major_steps = {};
  /// [s] The longest time from one instant to the next.
  double max_major_step_length = std::numeric_limits<double>::infinity();
  /// [s] Bounds of a solver step. They are rarely useful, because the tolerance chooses the step.
  double min_minor_step_size = 0.0;
  double max_minor_step_size = std::numeric_limits<double>::infinity();
  /// [s] The first solver step of the run that is tried; a step that misses the tolerance is
  /// shortened. Empty: the tolerance chooses it.
  std::optional<double> first_step = {};

  /// [s] If the firings of a guard follow each other within this time, with shrinking gaps, the
  /// guard comes to rest in a Zeno hold. With the default, the last gap is also at most a thousandth
  /// of the longest one, because a scene may have shorter times than a microsecond. 0 switches the
  /// monitor off. Flights lower than atol cannot be resolved, whatever this value is.
  double zeno_tolerance = default_zeno_tolerance;
  /// The number of interior points of a step at which guards are evaluated, to find two crossings
  /// in one step; 0 switches this off. Empty: the degree of the method's dense output, that is 4
  /// for dopri5, 7 for dop853, and for adams and bdf the present order, at least 3.
  std::optional<int> event_scan_points = {};
  /// The number of passes an instant may have before it counts as a loop without end.
  int max_passes = 100;
  /// The seed of the order in which executions of queued zero crossings with equal priority follow
  /// each other at one time: any finite number.
  double event_seed = 0.0;

  /// The parameters and start values with respect to which the run is differentiated, by the names
  /// of `Ensemble::vary`: "ball.e", "x[0]". See Results::sensitivities. Without any this costs
  /// nothing.
  std::vector<std::string> sensitivity = {};

  /// The signals to record, by name; without any, recording costs nothing.
  RecordedSignals recorded_signals = {};
  /// [s] Times to record at, increasing. If any are given, solver steps are recorded only with
  /// save_steps = true.
  std::vector<double> save_at = {};
  std::optional<bool> save_steps = {};
  /// Rows at events, at the start and at the end too. False: only one row for each time in save_at;
  /// at the time of an event it is the row after the event.
  bool event_rows = true;
  /// Keeps the interpolants of the solver, so that Results::at returns the state and the recorded
  /// signals at any time.
  bool dense_output = false;
  /// The event log; switching it off changes nothing else.
  bool record_events = true;
  /// Islands step apart: the parts of the system that read nothing of each other have steps,
  /// events and rows of their own, see Islands and Results::islands. Each island runs as if it were
  /// alone, to the bit. Event wires with delays lead from island to island; what arrives in a step cuts
  /// it by its dense output. False: all states have one common step. A later version may change the
  /// default.
  bool islands = false;
  /// The number of threads on which islands run, 0 for as many as the machine has cores. The results
  /// have the same bits on any number. With more than one, functions of the model are called from
  /// several threads at once; `interrupt` is called from that of the caller only. It needs `islands`.
  int island_threads = 1;

  /// May give leaves other functions while their plan is made.
  std::shared_ptr<Refinement> refinement = {};

  /// Throws SimulationError when a run does not end well; otherwise returns the results with the
  /// status.
  bool throw_errors = true;
  /// Called about every 20 ms; true ends the run with the status interrupted.
  std::function<bool()> interrupt = {};
};

}  // namespace saltus
