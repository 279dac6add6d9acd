// Timing: the cost of one run, cold and warm.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/report/scene.hpp"

namespace saltus {

/// Run times of one scene with one method; nothing is recorded. NaN if the run did not end well.
struct Timing {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double warm = unknown;  ///< [s] median of runs of a simulator used before
  double quartile1 = unknown, quartile3 = unknown;  ///< [s] half of the warm runs lie between them
  int repeats = 0;                                  ///< warm runs that were timed
  /// [s] median of the time to make the system, if the scene says how, its plan, and its first run.
  double cold = unknown;
};

struct TimingOptions {
  double least_time = 0.1;  ///< [s] warm runs are repeated for at least this time
  int most_repeats = 10000;
  int most_cold = 5;  ///< cold runs, within half of least_time; at least one
};

namespace detail {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The value below which a fraction q of the values lies, linear between neighbours: definition 7
/// of R. J. Hyndman, Y. Fan, "Sample quantiles in statistical packages", The American Statistician
/// 50 (1996) 361.
inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return Timing::unknown;
  std::ranges::sort(values);
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double rest = place - static_cast<double>(below);
  const double above = values[std::min(below + 1, values.size() - 1)];
  return values[below] + rest * (above - values[below]);
}

/// Times of `once`, repeated for `seconds`, at most `most` times; `between` is not timed.
template <class Once, class Between>
std::vector<double> repeated(Once&& once, Between&& between, double seconds, int most) {
  std::vector<double> times;
  const auto start = std::chrono::steady_clock::now();
  do {
    between();
    const auto begin = std::chrono::steady_clock::now();
    once();
    times.push_back(seconds_since(begin));
  } while (seconds_since(start) < seconds && static_cast<int>(times.size()) < most);
  return times;
}

}  // namespace detail

/// Times runs of a scene with these options. Only events are recorded. `between`, if any, is called
/// between runs and may throw to end them.
template <class Between>
Timing time_of_run(const Scene& scene, SimulatorOptions options, const TimingOptions& timing,
                   Between&& between) {
  options.recorded_signals.clear(), options.save_at.clear();
  options.save_steps = false;
  options.interrupt = {}, options.throw_errors = false;
  const double t = scene.span.begin;
  const Context begin = scene.context.time() == t ? scene.context : scene.context.with_time(t);
  const auto run = [&](Simulator& simulator) {
    simulator.initialize(begin);
    simulator.advance_to(scene.span.end);
  };
  const auto cold = detail::repeated(
      [&] {
        const auto system = scene.build ? scene.build() : scene.system;
        Simulator simulator(*system, options);
        run(simulator);
      },
      between, timing.least_time / 2, std::max(1, timing.most_cold));
  Simulator simulator(*scene.system, options);
  run(simulator);  // warm runs find everything that a first run makes
  const auto warm =
      detail::repeated([&] { run(simulator); }, between, timing.least_time, timing.most_repeats);
  return {.warm = detail::quantile(warm, 0.5),
          .quartile1 = detail::quantile(warm, 0.25),
          .quartile3 = detail::quantile(warm, 0.75),
          .repeats = static_cast<int>(warm.size()),
          .cold = detail::quantile(cold, 0.5)};
}

}  // namespace saltus
