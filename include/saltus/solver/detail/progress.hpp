// Progress: whether the steps of a solver still advance the time.
#pragma once

#include <cmath>

#include "saltus/solver/detail/cvode_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Watches whether the time advances. CVODE itself would continue where no time is left, before a
/// pole or a derivative that is not finite.
class Progress {
 public:
  void begin() { short_steps_ = 0; }

  /// A step of this length was made from t. Returns whether the last steps were so short that the
  /// time hardly advanced.
  bool stops_at(double t, double length) {
    const double rounding = thresholds::eps * std::abs(t);
    if (length > thresholds::least_step_roundings * rounding) return forget();
    advanced_ += length;
    if (++short_steps_ < thresholds::watched_steps) return false;
    const bool stops = advanced_ < thresholds::watched_steps * rounding || advanced_ == 0.0;
    return stops || forget();
  }

 private:
  bool forget() {
    short_steps_ = 0, advanced_ = 0.0;
    return false;
  }

  int short_steps_ = 0;    // in a row
  double advanced_ = 0.0;  // [s] by them
};

}  // namespace saltus
