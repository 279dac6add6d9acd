// Reference: a stored answer, cut to the span of a scene.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "saltus/report/scene.hpp"

namespace saltus::models::detail {

inline Eigen::VectorXd column(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Index>(values.size()));
}

/// The events of a guard that never rests.
inline EventTimes firings(std::string guard, std::vector<double> times) {
  return {std::move(guard), {{.times = std::move(times)}}};
}

/// The answer up to t_end. Its events must be known up to `known_until` [s]; a longer span has no
/// reference for them.
inline Exact until(double t_end, double known_until, Exact exact) {
  std::erase_if(exact.samples, [&](const Sample& sample) { return sample.time > t_end; });
  if (t_end > known_until) exact.events.clear();
  for (EventTimes& events : exact.events) {
    for (EventSeries& series : events.series)
      std::erase_if(series.times, [&](double t) { return t > t_end; });
  }
  return exact;
}

/// Records at the start and at the times of the samples.
inline Scene with_rows_at_samples(Scene scene) {
  scene.options.save_at = {scene.span.begin};
  for (const Sample& sample : scene.exact.samples) scene.options.save_at.push_back(sample.time);
  return scene;
}

}  // namespace saltus::models::detail
