// Work and precision: the error of a method at a tolerance, and its cost.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "saltus/report/environment.hpp"
#include "saltus/report/order.hpp"
#include "saltus/report/reference.hpp"
#include "saltus/solver/method.hpp"

namespace saltus {

/// One method at one tolerance.
struct WorkRow {
  std::string method = {};
  double rtol = 0.0, atol = 0.0;
  std::string against = {};  ///< "exact", "stored", or the method of the reference run
  Achieved achieved = {};
  Timing timing = {};
  Statistics statistics = {};
  double largest = 0.0;  ///< the largest recorded number
  Status status = Status::reached_end;
  std::string message = {};  ///< the reason, if the status is not a good one
};

struct WorkOptions {
  std::vector<Method> methods = {};  ///< empty: those that suit the scene
  std::vector<double> rtols = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  double atol_over_rtol = 0.0;  ///< 0: the ratio of the scene's own options
  TimingOptions timing = {};
  double time_limit = 5.0;  ///< [s] a longer run is stopped and shown as interrupted
  /// Called after each run and between timed runs; an exception from it ends the report.
  std::function<void(const Results*)> between = {};
};

/// All rows, their reference, and the environment of the measurement.
struct WorkReport {
  std::string scene = {}, title = {};
  TimeSpan span = {};
  double growth = 1.0;
  Reference reference = {};
  bool cold_makes_system = false;  ///< whether cold runs make the system, or begin with its plan
  std::vector<std::string> invariants = {};  ///< names, in the order of Achieved::drifts
  std::vector<WorkRow> rows = {};
  std::map<std::string, double> orders = {};  ///< visible order by method; NaN if there is none
  Environment environment = {};
};

namespace detail {

inline void between(const WorkOptions& work, const Results* results) {
  if (work.between) work.between(results);
}

inline double largest_of(const Results& results) {
  double largest = 0.0;
  for (const RecordedSignal& signal : results.signals) {
    for (const double value : signal.values) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// A run, or the reason why there is none: for example, the method refuses a tolerance.
inline std::optional<Results> attempt(WorkRow& row, const Scene& scene,
                                      const SimulatorOptions& options, double limit) {
  try {
    return simulate(*scene.system, scene.context, scene.span, bounded(options, limit));
  } catch (const ModelError& error) {
    row.status = Status::failed;
    row.message = error.what();
    return std::nullopt;
  }
}

/// Compares, counts and times one run, which may fail.
inline void fill(WorkRow& row, const Scene& scene, const SimulatorOptions& options,
                 const WorkOptions& work) {
  const auto results = attempt(row, scene, options, work.time_limit);
  if (!results) return;
  between(work, &*results);
  row.achieved = achieved(scene, *results, options);
  row.statistics = results->statistics;
  row.largest = largest_of(*results);
  row.status = results->status;
  row.message = row.status == Status::interrupted
                    ? text("stopped at t = ", results->context.time(), " s, after ",
                           work.time_limit, " s of run time")
                    : results->message;
  if (!ended_well(row.status)) return;
  row.timing = time_of_run(scene, options, work.timing, [&] { between(work, nullptr); });
}

/// The error at which rounding dominates: `steps` roundings of the largest state, times the growth
/// of the scene, times ten to be safe; or three times the bound of the reference.
inline double rounding_floor(const WorkReport& report, double largest, double steps) {
  const double eps = std::numeric_limits<double>::epsilon();
  const double rounding = 10.0 * eps * largest * std::sqrt(steps) * report.growth;
  const double bound = report.reference.bound;
  return std::max(rounding, std::isnan(bound) ? 0.0 : 3.0 * bound);
}

/// The visible order of a method with a fixed order; the other methods change theirs with the
/// tolerance. Runs that restart in more than one step of ten do not count, because events decide
/// the length of their steps; nor do runs with a wrong number of events.
inline double visible_order(const WorkReport& report, Method method) {
  if (method != Method::dopri5 && method != Method::dop853) return Achieved::unknown;
  std::vector<OrderPoint> runs;
  double most = 1.0, largest = 0.0;
  for (const WorkRow& row : report.rows) {
    if (row.method != to_string(method) || !ended_well(row.status)) continue;
    const Statistics& s = row.statistics;
    if (10 * s.restarts > s.steps || row.achieved.event_mismatch != 0) continue;
    const auto steps = static_cast<double>(row.statistics.steps);
    runs.push_back({steps, row.achieved.error});
    most = std::max(most, steps), largest = std::max(largest, row.largest);
  }
  return saltus::visible_order(std::move(runs), rounding_floor(report, largest, most));
}

/// The scene as a report runs it: with output times, if it is compared at these.
inline Scene prepared(Scene scene) {
  ReferenceOptions defaults;
  if (!is_known(scene.exact) && scene.options.save_at.empty())
    scene.options.save_at = even_times(scene.span, defaults.points);
  if (scene.gap || !scene.invariants.empty() || scene.options.save_at.empty())
    scene.options.save_steps = true;
  if (scene.options.recorded_signals.empty() &&
      (scene.exact.state || !scene.exact.samples.empty() || !scene.invariants.empty())) {
    throw ModelError(text("'", scene.name,
                          "': a known answer speaks of the recorded signals, and "
                          "nothing is recorded; give recorded_signals"));
  }
  return scene;
}

}  // namespace detail

/// Runs the scene once for the errors, then repeatedly for the time. A run that fails, or that is
/// refused, gives a row with its reason.
inline WorkRow measure(Scene scene, const SimulatorOptions& options, const Reference& reference,
                       const WorkOptions& work = {}) {
  WorkRow row{.method = std::string(to_string(options.ode_solver_method)),
              .rtol = options.rtol,
              .atol = options.atol};
  row.against = to_string(reference.kind);
  if (!reference.runs.empty()) {
    const auto other = std::ranges::find_if(
        reference.runs, [&](const ReferenceRun& run) { return run.method != row.method; });
    const ReferenceRun& run = other != reference.runs.end() ? *other : reference.runs.front();
    if (scene.exact.events.empty()) scene.exact.events = run.answer.events;
    if (reference.kind == ReferenceKind::run) {
      scene.exact.samples = run.answer.samples;
      row.against = run.method;
    }
  }
  detail::fill(row, scene, options, work);
  return row;
}

/// A row for each method at each tolerance; the other options of the scene remain unchanged. Throws
/// ModelError for a method that does not exist, and if there is nothing to compare with.
inline WorkReport work_precision(Scene scene, const WorkOptions& work = {}) {
  scene = detail::prepared(std::move(scene));
  const double ratio =
      work.atol_over_rtol > 0.0 ? work.atol_over_rtol : scene.options.atol / scene.options.rtol;
  const double tightest = work.rtols.empty() ? 1e-6 : *std::ranges::min_element(work.rtols);
  WorkReport report{.scene = scene.name,
                    .span = scene.span,
                    .growth = scene.growth,
                    .cold_makes_system = bool(scene.build),
                    .environment = environment()};
  for (const Invariant& invariant : scene.invariants) report.invariants.push_back(invariant.name);
  report.reference = reference_for(scene, {.rtol = tightest,
                                           .atol_over_rtol = ratio,
                                           .time_limit = 4.0 * work.time_limit,
                                           .between = work.between});
  const auto& methods = work.methods.empty() ? scene.methods : work.methods;
  for (const Method method : methods) {
    for (const double rtol : work.rtols) {
      SimulatorOptions options = scene.options;
      options.ode_solver_method = method;
      options.rtol = rtol;
      options.atol = rtol * ratio;
      report.rows.push_back(measure(scene, options, report.reference, work));
    }
    report.orders[std::string(to_string(method))] = detail::visible_order(report, method);
  }
  return report;
}

}  // namespace saltus
