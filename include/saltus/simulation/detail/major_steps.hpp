// Major steps: the stops that max_major_step_length asks for, between instants.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// Stops at `from + k length`, k = 1, 2, ..., where `from` is the time of the last instant. They
/// are counted, not added up: an end that lies within rounding of another stop is that stop.
class MajorSteps {
 public:
  explicit MajorSteps(double length) : length_(length) {}

  /// An instant at t [s]: the next step begins there.
  void begin(double t) { from_ = t; }

  /// [s] The next stop after t, given that of something else.
  double next(double t, double other) const {
    if (!std::isfinite(length_)) return other;
    const double count = std::floor((t - from_) / length_);
    double end = stop(count + 1.0);
    if (end <= t + rounding(end)) end = stop(count + 2.0);  // the division was rounded down
    end = std::max(end, std::nextafter(t, std::numeric_limits<double>::infinity()));
    return other <= end + rounding(end) ? other : end;
  }

 private:
  double stop(double k) const { return from_ + k * length_; }
  /// [s] Of a product and a sum, and of another stop that was computed likewise.
  double rounding(double end) const {
    return 2.0 * thresholds::eps * (std::abs(end) + std::abs(from_));
  }

  double length_;
  double from_ = 0.0;
};

}  // namespace saltus
