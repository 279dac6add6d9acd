// Laws: a closed form, a scaling to the bit, a ball at rest.
#pragma once

#include <algorithm>
#include <cmath>

#include "extremes/case.hpp"

namespace extremes {

/// The times of all firings of guards [s].
inline std::vector<double> firing_times(const saltus::EventLog& log) {
  std::vector<double> times;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].kind == saltus::EventKind::zero_crossing) times.push_back(log[i].time);
  }
  return times;
}

/// The allowed error: ten tolerances; a hundred for BDF on scenes that are not stiff, where it
/// takes ten times the steps.
inline double allowed(saltus::Method method) {
  return method == saltus::Method::bdf ? 100.0 : 10.0;
}

/// The known answer of a run.
struct Exact {
  Eigen::VectorXd end = {};        ///< the state at the end; not compared if empty
  Eigen::VectorXd size = {};       ///< of each state on the way, for rtol; by default at the end
  double growth = 1.0;             ///< the error at the end from a local error of one tolerance
  std::vector<double> times = {};  ///< [s] of all firings
  bool events = false;             ///< whether the times are compared
  double speed = 1.0;              ///< |dg/dt| of the guards, slowest, for errors of time
  double power = 0.0;              ///< the unit of event k = 1, 2, ... grows as k^power
};

/// The root mean square over the states of error / unit, the norm in which steps are controlled.
/// The unit is (rtol |x| + atol) growth, plus eps |x| for each step, which is the number of
/// roundings.
inline double error_of_state(const Exact& exact, const Results& results,
                             const SimulatorOptions& with) {
  if (exact.end.size() == 0) return 0.0;
  const Eigen::VectorXd& x = results.context.continuous_state();
  const auto steps = static_cast<double>(results.statistics.steps);
  double sum = 0.0;
  for (Index i = 0; i < x.size(); ++i) {
    const double size = std::abs(exact.size.size() ? exact.size[i] : exact.end[i]);
    const double unit = (with.rtol * size + with.atol) * exact.growth + steps * eps * size;
    const double error = x[i] == exact.end[i] ? 0.0 : std::abs(x[i] - exact.end[i]) / unit;
    if (!std::isfinite(error)) return infinite;
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(x.size()));
}

/// The largest error of an event time, in units of the time that a unit of the state takes at its
/// speed. The location error 100 eps t (docs/semantics.md, 2.9) is not counted.
inline double error_of_times(const Exact& exact, const std::vector<double>& found,
                             const Results& results, const SimulatorOptions& with) {
  const Eigen::VectorXd& sizes = exact.size.size() ? exact.size : exact.end;
  const double size = sizes.size() ? sizes.cwiseAbs().maxCoeff() : 1.0;
  const auto steps = static_cast<double>(results.statistics.steps);
  const double unit =
      ((with.rtol * size + with.atol) * exact.growth + steps * eps * size) / exact.speed;
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(found.size(), exact.times.size()); ++i) {
    const double late = std::abs(found[i] - exact.times[i]) - 100.0 * eps * std::abs(found[i]);
    worst = std::max(worst, late / (unit * std::pow(static_cast<double>(i + 1), exact.power)));
  }
  return worst;
}

inline Law meets(Exact exact) {
  return [exact = std::move(exact)](const Results& results, const SimulatorOptions& with) {
    Finding finding{.error = error_of_state(exact, results, with),
                    .allowed = allowed(with.ode_solver_method)};
    if (!exact.events) return finding;
    const std::vector<double> found = firing_times(results.events);
    finding.error = std::max(finding.error, error_of_times(exact, found, results, with));
    finding.events = text(found.size(), " of ", exact.times.size());
    finding.events_right = found.size() == exact.times.size();
    return finding;
  };
}

/// The run must equal `base` with its times multiplied by 2^time and its state i by 2^states[i], to
/// the last bit, because only exponents differ. The error is the largest difference, in units of
/// rtol.
inline Law scales(std::function<Trial()> base, int time, std::vector<int> states) {
  return [=](const Results& results, const SimulatorOptions& with) {
    Trial plain = base();
    plain.options.ode_solver_method = with.ode_solver_method;
    const Results reference =
        saltus::simulate(*plain.system, plain.start, plain.span, plain.options);
    Finding finding{.allowed = 0.0};
    const auto compare = [&](double found, double unscaled, int exponent) {
      const double expected = std::ldexp(unscaled, exponent);
      if (found == expected) return;
      const double error = std::abs(found / expected - 1.0) / with.rtol;
      finding.error = std::isnan(error) ? infinite : std::max(finding.error, error);
    };
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto k = static_cast<Index>(i);
      compare(results.context.continuous_state()[k], reference.context.continuous_state()[k],
              states[i]);
    }
    const auto found = firing_times(results.events), expected = firing_times(reference.events);
    for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
      compare(found[i], expected[i], time);
    if (!expected.empty()) finding.events = text(found.size(), " of ", expected.size());
    finding.events_right = found.size() == expected.size();
    return finding;
  };
}

}  // namespace extremes
