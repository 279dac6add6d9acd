// WaveLooks: how far apart the looks of a step may be where the periods of the guards are known.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/flow_variables.hpp"
#include "saltus/plan/detail/guard_waves.hpp"
#include "saltus/solver/detail/guard_set.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"

namespace saltus {

/// A guard by a sine of the time may be at rest for some periods, because the amplitude is zero then, and
/// looks at it say nothing of the periods that follow. Its expression does: the argument of the sine goes
/// through so many periods in a step. A guard whose bounds over the step exclude zero needs no looks.
class WaveLooks {
 public:
  explicit WaveLooks(Machine& machine)
      : machine_(&machine),
        variables_(machine),
        x_from_(machine.plan().nx),
        x_to_(machine.plan().nx) {}

  /// Whether some guards have known periods.
  bool any() {
    if (machine_->functions() != functions_) {
      functions_ = machine_->functions();
      waves_ = guard_waves(machine_->plan());
    }
    return waves_->guards.has_value();
  }

  /// A part of a step, between two times [s].
  struct Part {
    double from, to;
    bool monitors;  ///< which guards are located
  };

  /// [s] The longest distance of looks that show each located guard which may come to zero in the part;
  /// infinite if the whole part may pass without a look, or if nothing is known. `state(t, x)` gives the state
  /// at t.
  template <class State>
  double longest(const GuardSet& guards, const Part& part, const State& state) {
    bound(*waves_->arguments, part, state, arguments_);
    const auto any = [](const GuardWaves::Wave&) { return true; };
    if (!(most_periods(guards, part, any) > thresholds::wave_share)) return all;
    bound(*waves_->guards, part, state, bounds_);
    const double length = part.to - part.from;
    return thresholds::wave_share * length /
           most_periods(guards, part, [this](const GuardWaves::Wave& wave) {
             return bounds_[wave.guard].has_zero();
           });
  }

 private:
  static constexpr double all = std::numeric_limits<double>::infinity();

  template <class State>
  void bound(const tape::Ranges& ranges, const Part& part, const State& state,
             List<tape::ValueRange>& bounds) {
    if (ranges.reads_state()) state(part.from, x_from_.data()), state(part.to, x_to_.data());
    variables_.at(part.from, x_from_.data(),
                  [&](const At& at) { ranges.evaluate(at, part.to, x_to_.data(), bounds); });
  }

  /// The most periods that an argument goes through, of the located guards that count. Bounds without an end
  /// say nothing.
  template <class Counts>
  double most_periods(const GuardSet& guards, const Part& part, const Counts& counts) const {
    double most = 0.0;
    for (const GuardWaves::Wave& wave : waves_->waves) {
      const Guard& guard = guards[wave.slot];
      if (!guard.active || guard.monitor != part.monitors || !counts(wave)) continue;
      const double periods = arguments_[wave.argument].width() / wave.period;
      if (std::isfinite(periods)) most = std::max(most, periods);
    }
    return most;
  }

  Machine* machine_;
  FlowVariables variables_;
  int functions_ = -1;  // of the machine, of which the waves are made
  std::shared_ptr<const GuardWaves> waves_;
  List<tape::ValueRange> arguments_, bounds_;  // those of the guards are the second
  Eigen::VectorXd x_from_, x_to_;              // at the ends of a part
};

}  // namespace saltus
