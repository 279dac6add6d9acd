// Whether rounding explains what Newton's iteration leaves of an equation.
#pragma once

#include <cmath>

#include "saltus/solver/detail/radau/tuning.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus::radau {

/// The rounding of f is seen by a relative change of the states.
inline double slightly_changed(double x) { return x * (1.0 + tuning::seen_change); }

/// Whether `residual` of x = x0 + h f is as small as the rounding of x and of h f. `moved` is f at
/// the slightly changed states.
inline bool rounding_explains(double residual, double x, double h, double f, double moved) {
  constexpr double roundings = tuning::residual_roundings * thresholds::eps;
  const double noise = std::abs(moved - f) / tuning::seen_change + std::abs(f);
  return std::abs(residual) <= roundings * (std::abs(x) + h * noise);
}

}  // namespace saltus::radau
