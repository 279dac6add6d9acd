// Achieved: the distance of a run from the known answer. Event times are judged apart from states.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "saltus/report/observed.hpp"
#include "saltus/report/scene.hpp"

namespace saltus {

/// Worst errors of one run; NaN if there was nothing to compare.
struct Achieved {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double error = unknown;  ///< max over rows and components of |x - exact|
  /// The same error divided by atol + rtol |exact|; it is large where a component passes zero.
  double scaled = unknown;
  double event_error = unknown;  ///< [s] over events, matched by index
  /// The number of events too many or too few. A hold that was not entered or not released counts
  /// as one.
  std::int64_t event_mismatch = 0;
  double penetration = unknown;         ///< max(-gap) over rows, 0 if the gap stays positive
  double invariant_drift = unknown;     ///< the largest of `drifts`
  std::vector<double> drifts = {};      ///< max |value - value at the start|, for each invariant
  double accumulation_error = unknown;  ///< [s] of the predicted Zeno times
  double rest_error = unknown;          ///< as `error`, but over the rows within Zeno holds
  double release_error = unknown;       ///< [s] of the ends of Zeno holds
};

namespace detail {

/// A max that drops NaN on the left and keeps NaN on the right: a run that gives NaN has no small
/// error.
inline void raise(double& worst, double value) {
  if (std::isnan(worst) || !(value <= worst)) worst = value;
}

inline void compare_series(Achieved& a, const EventSeries& exact, const EventSeries& found,
                           double end) {
  const std::size_t both = std::min(exact.times.size(), found.times.size());
  for (std::size_t i = 0; i < both; ++i)
    raise(a.event_error, std::abs(found.times[i] - exact.times[i]));
  const bool rests = exact.accumulation <= end, held = std::isfinite(found.accumulation);
  // A hold represents the infinitely many events after it.
  const std::size_t expected = rests && held ? both : exact.times.size();
  a.event_mismatch +=
      std::abs(static_cast<std::int64_t>(found.times.size()) - static_cast<std::int64_t>(expected));
  if (rests != held) ++a.event_mismatch;
  if (rests && held) raise(a.accumulation_error, std::abs(found.accumulation - exact.accumulation));
  if (std::isfinite(exact.release) != std::isfinite(found.release))
    ++a.event_mismatch;
  else if (std::isfinite(exact.release))
    raise(a.release_error, std::abs(found.release - exact.release));
}

inline void compare_events(Achieved& a, const EventTimes& exact, const Results& results,
                           double end) {
  std::vector<EventSeries> found = observed_series(results.events, exact.guard);
  std::vector<EventSeries> expected = exact.series;
  const std::size_t most = std::max(found.size(), expected.size());
  found.resize(most), expected.resize(most);
  for (std::size_t i = 0; i < most; ++i) compare_series(a, expected[i], found[i], end);
}

/// One row of the recorded signals, concatenated.
inline Eigen::VectorXd row_of(const Results& results, std::size_t row) {
  Index width = 0, at = 0;
  for (const RecordedSignal& signal : results.signals) width += signal.shape.size;
  Eigen::VectorXd values(width);
  for (const RecordedSignal& signal : results.signals) {
    values.segment(at, signal.shape.size) =
        signal.matrix().row(static_cast<Index>(row)).transpose();
    at += signal.shape.size;
  }
  return values;
}

inline void compare_row(Achieved& a, const Eigen::VectorXd& x, const Eigen::VectorXd& exact,
                        const SimulatorOptions& o) {
  if (x.size() != exact.size()) {
    throw ModelError(text("a known answer: expected ", x.size(),
                          " numbers, as many as the recorded signals have, found ", exact.size()));
  }
  for (Index i = 0; i < exact.size(); ++i) {
    const double error = std::abs(x[i] - exact[i]);
    raise(a.error, error);
    raise(a.scaled, error / (o.atol + o.rtol * std::abs(exact[i])));
  }
}

inline void compare_states(Achieved& a, const Exact& exact, const Results& results,
                           const SimulatorOptions& options) {
  BranchWalk walk(results.events,
                  exact.events.empty() ? std::string_view() : exact.events.front().guard);
  for (std::size_t row = 0; row < results.time.size(); ++row) {
    const double t = results.time[row];
    const Branch branch = walk.at(t, results.jump[row]);
    const Eigen::VectorXd x = row_of(results, row), expected = exact.state(t, branch);
    compare_row(a, x, expected, options);
    if (branch.rest) raise(a.rest_error, (x - expected).lpNorm<Eigen::Infinity>());
  }
}

/// Whether an event of the known answer is so near that the two trajectories may be on different
/// sides of it: within twice the worst event error. This bound is at most a hundredth of the span;
/// otherwise a run that misses an event would be spared.
inline bool near_event(const Exact& exact, double t, double event_error, double span) {
  if (std::isnan(event_error)) return false;
  const double reach = std::min(2.0 * event_error, 0.01 * span);
  return std::ranges::any_of(exact.events, [&](const EventTimes& events) {
    return std::ranges::any_of(events.series, [&](const EventSeries& series) {
      const auto next = std::ranges::lower_bound(series.times, t - reach);
      return next != series.times.end() && *next <= t + reach;
    });
  });
}

/// Compares the samples for which the run has a row. A run that ended early says so in its status.
inline void compare_samples(Achieved& a, const Scene& scene, const Results& results,
                            const SimulatorOptions& options) {
  const double span = scene.span.end - scene.span.begin;
  for (const Sample& sample : scene.exact.samples) {
    const auto row = std::ranges::lower_bound(results.time, sample.time);
    if (row == results.time.end() || *row != sample.time) continue;
    if (near_event(scene.exact, sample.time, a.event_error, span)) continue;
    compare_row(a, row_of(results, static_cast<std::size_t>(row - results.time.begin())),
                sample.state, options);
  }
}

/// Judges the rows without a known answer: how deep they are under a surface, and how far
/// invariants drift.
inline void judge_rows(Achieved& a, const Scene& scene, const Results& results) {
  if (!scene.gap && scene.invariants.empty()) return;
  std::vector<double> start;
  for (std::size_t row = 0; row < results.time.size(); ++row) {
    const double t = results.time[row];
    const Eigen::VectorXd x = row_of(results, row);
    if (scene.gap) raise(a.penetration, std::max(0.0, -scene.gap(t, x)));
    for (std::size_t k = 0; k < scene.invariants.size(); ++k) {
      const double value = scene.invariants[k].value(t, x);
      if (start.size() <= k) start.push_back(value), a.drifts.push_back(0.0);
      raise(a.drifts[k], std::abs(value - start[k]));
    }
  }
  for (const double drift : a.drifts) raise(a.invariant_drift, drift);
}

}  // namespace detail

/// Compares a run of the scene with the known answer. It needs the event log and, for states, the
/// recorded signals.
inline Achieved achieved(const Scene& scene, const Results& results,
                         const SimulatorOptions& options) {
  Achieved a;
  for (const EventTimes& events : scene.exact.events)
    detail::compare_events(a, events, results, scene.span.end);
  if (scene.exact.state) detail::compare_states(a, scene.exact, results, options);
  detail::compare_samples(a, scene, results, options);
  detail::judge_rows(a, scene, results);
  return a;
}
inline Achieved achieved(const Scene& scene, const Results& results) {
  return achieved(scene, results, scene.options);
}

}  // namespace saltus
