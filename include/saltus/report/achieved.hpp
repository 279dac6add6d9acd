// Achieved: how far a run is from the known answer. Event times are judged apart from states.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "saltus/report/observed.hpp"
#include "saltus/report/scene.hpp"

namespace saltus {

/// Worst errors of one run; NaN where there was nothing to compare.
struct Achieved {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double error = unknown;  ///< max over rows and components of |x - exact|
  double scaled =
      unknown;  ///< the same over atol + rtol |exact|; large where a component passes zero
  double event_error = unknown;  ///< [s] over events, matched by index
  std::int64_t event_mismatch =
      0;  ///< events too many or too few; holds not entered or not released count as one
  double accumulation_error = unknown;  ///< [s] of the predicted Zeno times
  double release_error = unknown;       ///< [s] of the ends of Zeno holds
};

namespace detail {

/// max that forgets NaN on the left and keeps it on the right: a run that gives NaN has no small
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
  // A hold stands for the infinitely many events behind it.
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

/// One row of the recorded signals, one after the other.
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
    compare_row(a, row_of(results, row), exact.state(t, walk.at(t, results.jump[row])), options);
  }
}

/// A sample that the run has no row for is not compared: a run that ended early says so in its
/// status.
inline void compare_samples(Achieved& a, const Exact& exact, const Results& results,
                            const SimulatorOptions& options) {
  for (const Sample& sample : exact.samples) {
    const auto row = std::ranges::lower_bound(results.time, sample.time);
    if (row == results.time.end() || *row != sample.time) continue;
    compare_row(a, row_of(results, static_cast<std::size_t>(row - results.time.begin())),
                sample.state, options);
  }
}

}  // namespace detail

/// Compares a run of the scene with what is known. Needs the event log and, for states, the
/// recorded signals.
inline Achieved achieved(const Scene& scene, const Results& results,
                         const SimulatorOptions& options) {
  Achieved a;
  for (const EventTimes& events : scene.exact.events)
    detail::compare_events(a, events, results, scene.span.end);
  if (scene.exact.state) detail::compare_states(a, scene.exact, results, options);
  detail::compare_samples(a, scene.exact, results, options);
  return a;
}
inline Achieved achieved(const Scene& scene, const Results& results) {
  return achieved(scene, results, scene.options);
}

}  // namespace saltus
