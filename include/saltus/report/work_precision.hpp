// Work and precision: what error a method achieves at a tolerance, and what that costs.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "saltus/report/achieved.hpp"

namespace saltus {

/// One method at one tolerance.
struct WorkRow {
  std::string method = {};
  double rtol = 0.0, atol = 0.0;
  Achieved achieved = {};
  double seconds = std::numeric_limits<double>::quiet_NaN();  ///< [s] median of a warm run that
                                                              ///< records no signals
  Statistics statistics = {};
  Status status = Status::reached_end;
  std::string message = {};  ///< why, where the status is none of the good ones
};

struct WorkOptions {
  std::vector<std::string> methods = {"dopri5", "adams", "bdf", "auto"};
  std::vector<double> rtols = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  double atol_over_rtol = 1e-2;
  double least_time = 0.1;  ///< [s] a row is timed for at least this long, in repeated runs
  int most_repeats = 10000;
  double time_limit =
      5.0;  ///< [s] a single run that takes longer is stopped, and shown as interrupted
};

namespace detail {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Options of a run that gives up after `limit` seconds of wall time.
inline SimulatorOptions bounded(SimulatorOptions options, double limit) {
  options.interrupt = [limit, start = std::chrono::steady_clock::now()] {
    return seconds_since(start) > limit;
  };
  options.throw_errors = false;
  return options;
}

/// Median of the time of one run, first run not counted. The simulator is re-used, nothing but
/// events is recorded.
inline double time_of_run(const Scene& scene, SimulatorOptions options, const WorkOptions& work) {
  options.recorded_signals.clear();
  options.save_at.clear();
  options.interrupt = {};
  Simulator simulator(*scene.system, options);
  const auto run = [&] {
    const auto start = std::chrono::steady_clock::now();
    simulator.initialize(scene.context);
    simulator.advance_to(scene.span.end);
    return seconds_since(start);
  };
  run();
  std::vector<double> times;
  const auto start = std::chrono::steady_clock::now();
  do times.push_back(run());
  while (seconds_since(start) < work.least_time &&
         static_cast<int>(times.size()) < work.most_repeats);
  return median(std::move(times));
}

}  // namespace detail

/// Runs the scene once for the errors, then again and again for the time. A run that fails gives a
/// row that says so.
inline WorkRow measure(const Scene& scene, const SimulatorOptions& options,
                       const WorkOptions& work = {}) {
  WorkRow row{.method = options.ode_solver_method, .rtol = options.rtol, .atol = options.atol};
  const Results results =
      simulate(*scene.system, scene.context, scene.span, detail::bounded(options, work.time_limit));
  row.achieved = achieved(scene, results, options);
  row.statistics = results.statistics;
  row.status = results.status;
  row.message = results.status == Status::interrupted
                    ? text("stopped at t = ", results.context.time(), " s, after ", work.time_limit,
                           " s of run time")
                    : results.message;
  if (ended_well(row.status)) row.seconds = detail::time_of_run(scene, options, work);
  return row;
}

/// A row for each method at each tolerance; the scene's other options stay as they are.
inline std::vector<WorkRow> work_precision(const Scene& scene, const WorkOptions& work = {}) {
  std::vector<WorkRow> rows;
  for (const std::string& method : work.methods) {
    for (const double rtol : work.rtols) {
      SimulatorOptions options = scene.options;
      options.ode_solver_method = method;
      options.rtol = rtol;
      options.atol = rtol * work.atol_over_rtol;
      rows.push_back(measure(scene, options, work));
    }
  }
  return rows;
}

}  // namespace saltus
