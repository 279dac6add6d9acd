// Reference: the answer that the rows of a report are compared with, and its own accuracy.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/report/achieved.hpp"
#include "saltus/report/timing.hpp"

namespace saltus {

enum class ReferenceKind {
  exact,   ///< a closed form
  stored,  ///< numbers computed elsewhere, with their provenance
  run      ///< runs of this scene by the report, two orders tighter and by another method
};

inline std::string_view to_string(ReferenceKind kind) {
  constexpr std::string_view names[] = {"exact", "stored", "run"};
  return nth(names, kind);
}

/// A run that other runs are compared with.
struct ReferenceRun {
  std::string method;
  double rtol = 0.0, atol = 0.0;
  Exact answer;
};

struct Reference {
  ReferenceKind kind = ReferenceKind::exact;
  std::string provenance = {};
  /// A bound of the error of a reference of kind run, in states and [s] in event times. It is NaN
  /// for the other kinds, whose provenance gives it.
  double bound = Achieved::unknown, event_bound = Achieved::unknown;
  std::vector<ReferenceRun> runs = {};  ///< one, or two by different methods
};

struct ReferenceOptions {
  double rtol = 1e-12;  ///< the tightest tolerance of the report
  double atol_over_rtol = 1e-2;
  int points = 100;         ///< output times, if the scene's save_at is empty
  double time_limit = 5.0;  ///< [s] wall time of one run
  /// Called after each run; an exception from it ends the search.
  std::function<void(const Results*)> between = {};
};

namespace detail {

/// A number with two digits, the precision of an error or a time. "-" if it is unknown.
inline std::string short_number(double value) {
  if (std::isnan(value)) return "-";
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.1e", value);
  return buffer.data();
}

inline bool is_known(const Exact& exact) { return exact.state || !exact.samples.empty(); }

/// Options of a run that ends after `limit` seconds of wall time, or when `asked` returns true.
inline SimulatorOptions bounded(SimulatorOptions options, double limit) {
  options.interrupt = [limit, asked = std::move(options.interrupt),
                       start = std::chrono::steady_clock::now()] {
    return seconds_since(start) > limit || (asked && asked());
  };
  options.throw_errors = false;
  return options;
}

inline std::vector<double> even_times(TimeSpan span, int points) {
  std::vector<double> times;
  for (int i = 1; i < points; ++i)
    times.push_back(span.begin + (span.end - span.begin) * i / points);
  times.push_back(span.end);
  return times;
}

/// The names of all events that a run can log, except time events.
inline std::vector<std::string> guard_names(const Scene& scene, const SimulatorOptions& options) {
  const Simulator simulator(*scene.system, options);
  std::vector<std::string> names;
  for (const auto& group : simulator.plan().guards) names.push_back(group.name);
  for (const auto& edge : simulator.plan().edges) names.push_back(edge.name);
  return names;
}

/// The result of a run, in the terms of a known answer.
inline Exact answer_of(const Scene& scene, const Results& results,
                       const std::vector<std::string>& guards) {
  Exact answer;
  for (const std::string& guard : guards)
    answer.events.push_back({guard, observed_series(results.events, guard)});
  for (const double t : scene.options.save_at) {
    const auto row = std::ranges::lower_bound(results.time, t);
    if (row == results.time.end() || *row != t) continue;
    answer.samples.push_back(
        {t, row_of(results, static_cast<std::size_t>(row - results.time.begin()))});
  }
  return answer;
}

/// A run that reaches its end. It is two orders tighter than asked, or one order if the method
/// refuses that.
inline std::optional<ReferenceRun> reference_run(const Scene& scene, Method method,
                                                 const ReferenceOptions& with,
                                                 std::string& reasons) {
  for (const double tighter : {1e-2, 1e-1}) {
    SimulatorOptions options = scene.options;
    options.ode_solver_method = method;
    options.rtol = std::max(with.rtol * tighter, 1e-14);
    options.atol = options.rtol * with.atol_over_rtol;
    options.record_events = true;
    const Results results =
        simulate(*scene.system, scene.context, scene.span, bounded(options, with.time_limit));
    if (with.between) with.between(&results);
    if (ended_well(results.status)) {
      return ReferenceRun{std::string(to_string(method)), options.rtol, options.atol,
                          answer_of(scene, results, guard_names(scene, options))};
    }
    reasons += text("\n  ", to_string(method), ", rtol ", options.rtol.smallest(), ": ",
                    results.message.empty()
                        ? text(to_string(results.status), " at t = ", results.context.time(), " s")
                        : results.message);
    if (results.status == Status::interrupted) return std::nullopt;
  }
  return std::nullopt;
}

/// Methods in the order of trial: first those that suit the scene, those that are more accurate at
/// a given tolerance first; then a method that does not suit the scene but may still reach the end.
inline std::vector<Method> reference_methods(const Scene& scene) {
  std::vector<Method> suit, others;
  for (const Method method : {Method::dop853, Method::dopri5, Method::adams, Method::bdf}) {
    const bool suits = std::ranges::find(scene.methods, method) != scene.methods.end();
    (suits ? suit : others).push_back(method);
  }
  if (!others.empty()) suit.push_back(others.front());
  return suit;
}

/// The largest differences between two answers, in states and in event times.
inline std::pair<double, double> difference(const Scene& scene, const ReferenceRun& a,
                                            const ReferenceRun& b) {
  Achieved worst;
  for (std::size_t i = 0; i < std::min(a.answer.events.size(), b.answer.events.size()); ++i) {
    const auto &left = a.answer.events[i].series, &right = b.answer.events[i].series;
    for (std::size_t s = 0; s < std::min(left.size(), right.size()); ++s)
      compare_series(worst, left[s], right[s], scene.span.end);
  }
  if (worst.event_mismatch != 0) return {Achieved::unknown, Achieved::unknown};
  const double span = scene.span.end - scene.span.begin;
  for (std::size_t i = 0; i < std::min(a.answer.samples.size(), b.answer.samples.size()); ++i) {
    const Sample& sample = a.answer.samples[i];
    if (!near_event(a.answer, sample.time, worst.event_error, span))
      compare_row(worst, b.answer.samples[i].state, sample.state, scene.options);
  }
  return {worst.error, worst.event_error};
}

inline double largest_state(const Exact& answer) {
  double largest = 0.0;
  for (const Sample& sample : answer.samples)
    largest = std::max(largest, sample.state.lpNorm<Eigen::Infinity>());
  return largest;
}

inline std::string name_of(const ReferenceRun& run) {
  return text(run.method, " at rtol ", run.rtol, ", atol ", run.atol);
}

/// The error bound of the runs: twice the difference of two methods, because the better of two so
/// different methods is hardly more than half as wrong as the other. The bound is at least the
/// limit for every method here: 10 (rtol |x| + atol) times the growth; and for an event time 100
/// eps (|t| + h), h <= |t|.
inline void judge(Reference& reference, const Scene& scene) {
  const ReferenceRun& first = reference.runs.front();
  const double held = 10.0 * (first.rtol * largest_state(first.answer) + first.atol) * scene.growth;
  std::string says = text("a run of ", name_of(first),
                          "; no second method came to the end, so nothing confirms it");
  if (reference.runs.size() == 2) {
    const auto [states, events] = difference(scene, first, reference.runs[1]);
    const double eps = std::numeric_limits<double>::epsilon();
    if (!std::isnan(states) && reference.kind == ReferenceKind::run)
      reference.bound = std::max(2.0 * states, held);
    if (!std::isnan(events))
      reference.event_bound = std::max(2.0 * events, 200.0 * eps * std::abs(scene.span.end));
    const double agree = reference.kind == ReferenceKind::run ? states : events;
    says = text("runs of ", name_of(first), " and of ", name_of(reference.runs[1]),
                std::isnan(agree) ? "; they do not agree about the events"
                                  : text("; they agree to ", short_number(agree)));
  }
  if (reference.kind != ReferenceKind::run)
    says = text("states: ", reference.provenance, "; event times: ", says);
  else if (!scene.exact.events.empty())
    says = text("event times: ", scene.exact.provenance, "; states: ", says);
  reference.provenance = says;
}

}  // namespace detail

namespace detail {

/// Runs of two methods that reach the end, or fewer if no two methods do. `reasons` says why the
/// others did not.
inline std::vector<ReferenceRun> two_runs(const Scene& scene, const ReferenceOptions& with,
                                          std::string& reasons) {
  std::vector<ReferenceRun> runs;
  for (const Method method : reference_methods(scene)) {
    if (auto run = reference_run(scene, method, with, reasons)) runs.push_back(*run);
    if (runs.size() == 2) break;
  }
  return runs;
}

}  // namespace detail

/// The known answer of a scene. If states are unknown, or the event times of a scene with guards,
/// they come from two runs by different methods at the output times, so that each method is
/// compared with another one. Throws ModelError if no state is known and no method reaches the end.
inline Reference reference_for(const Scene& scene, const ReferenceOptions& with) {
  const Exact& exact = scene.exact;
  const bool closed = exact.state || exact.samples_are_exact;
  Reference reference{.kind = !detail::is_known(exact) ? ReferenceKind::run
                              : closed                 ? ReferenceKind::exact
                                                       : ReferenceKind::stored,
                      .provenance = exact.provenance};
  const bool states = detail::is_known(exact);
  const bool events = !exact.events.empty() || detail::guard_names(scene, scene.options).empty();
  if (states && events) return reference;
  std::string reasons;
  reference.runs = detail::two_runs(scene, with, reasons);
  if (reference.runs.empty() && !states) {
    throw ModelError(text("no reference for '", scene.name,
                          "': nothing is known about it, and no method came to the end within ",
                          with.time_limit, " s; give a known answer, or looser tolerances",
                          reasons));
  }
  if (!reference.runs.empty()) detail::judge(reference, scene);
  return reference;
}

}  // namespace saltus
