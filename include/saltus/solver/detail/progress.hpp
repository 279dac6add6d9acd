// Progress: whether the steps of a solver still advance the time.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "saltus/base/view.hpp"
#include "saltus/solver/detail/cvode_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Watches whether the time and the state advance. CVODE itself would continue where no time is
/// left, before a pole or a derivative that is not finite; or with steps that are below the rounding
/// of every state.
class Progress {
 public:
  void begin() { short_steps_ = 0; }

  /// A step of this length was made from t, to x. Returns whether the last steps were so short that
  /// the time hardly advanced, or the state did not change at all.
  bool stops_at(double t, double length, const double* x, Index n) {
    const double rounding = thresholds::eps * std::abs(t);
    if (length > thresholds::least_step_roundings * rounding) return forget();
    advanced_ += length;
    if (++short_steps_ == 1) first_.assign(x, x + n);
    if (short_steps_ < thresholds::watched_steps) return false;
    const bool stands = n > 0 && std::equal(first_.begin(), first_.end(), x);
    const bool late = advanced_ < thresholds::watched_steps * rounding || advanced_ == 0.0;
    return stands || late || forget();
  }

 private:
  bool forget() {
    short_steps_ = 0, advanced_ = 0.0;
    return false;
  }

  int short_steps_ = 0;        // in a row
  double advanced_ = 0.0;      // [s] by them
  std::vector<double> first_;  // the state after the first of them
};

}  // namespace saltus
