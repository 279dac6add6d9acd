// SimulatorOptions: how a run is done.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "saltus/plan/plan.hpp"

namespace saltus {

struct SimulatorOptions {
  /// Relative and absolute tolerance of a minor step: the root mean square over the states of
  /// error / (atol + rtol |x|) stays below 1.
  double rtol = 1e-6;
  double atol = 1e-8;

  /// "auto" (dopri5 or dop853 by tolerance, BDF while the scene is stiff), "dopri5", "dop853",
  /// "adams", "bdf". Synonyms: "rk45", "RK45" and "non-stiff" for dopri5, "DOP853" for dop853,
  /// "stiff" and "BDF" for bdf.
  std::string ode_solver_method = "auto";

  /// How a stiff method solves its linear systems: "auto" (by number of states and places of the
  /// Jacobian), "dense", "band", "sparse" or "gmres". The statistics say what was chosen, and why.
  std::string linear_solver = "auto";
  /// Where a block of more than 256 states declares neither Jacobian nor sparsity, a stiff method
  /// finds the sparsity by calls of its derivative near the state. The statistics say what was
  /// found. False: such a block is full, or its places are unknown.
  bool find_sparsity = true;

  /// Instants a run may have; more end it with the status step_limit. Not said: no limit.
  std::optional<std::int64_t> max_major_steps = {};
  /// [s] longest time from one instant to the next.
  double max_major_step_length = std::numeric_limits<double>::infinity();
  /// [s] bounds of a solver step. Rarely of use: the tolerance chooses the step.
  double min_minor_step_size = 0.0;
  double max_minor_step_size = std::numeric_limits<double>::infinity();

  /// [s] A guard whose firings follow each other this closely, with shrinking gaps, comes to rest:
  /// a Zeno hold. 0 switches the monitor off. Flights lower than atol cannot be seen, whatever
  /// stands here.
  double zeno_tolerance = 1e-6;
  /// Interior points of a step at which guards are looked at, for two crossings in one step; 0
  /// turns that off.
  int event_scan_points = 3;
  /// Passes an instant may have before it counts as a loop without end.
  int max_passes = 100;

  /// What is recorded, by name; nothing recorded costs nothing.
  RecordedSignals recorded_signals = {};
  /// [s] Times to record at, increasing. If any are given, solver steps are recorded only with
  /// save_steps = true.
  std::vector<double> save_at = {};
  std::optional<bool> save_steps = {};
  /// Rows at events, at the start and at the end too. False: rows at save_at only, one for each, at
  /// the time of an event the one after it.
  bool event_rows = true;
  /// Keep what the solver interpolates, so that Results::at tells state and recorded signals at any
  /// time.
  bool dense_output = false;
  /// The event log; switching it off changes nothing else.
  bool record_events = true;

  /// Raise SimulationError when a run does not end well; else return the results with the status.
  bool throw_errors = true;
  /// Asked about every 20 ms; true ends the run with the status interrupted.
  std::function<bool()> interrupt = {};
};

namespace detail {

/// Throws ModelError for the first option that makes no sense.
void check(const SimulatorOptions& o);

}  // namespace detail

}  // namespace saltus
