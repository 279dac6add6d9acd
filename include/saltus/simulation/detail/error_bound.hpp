// Error bound: the value within which a guard counts as zero.
//
// A guard is a number g(t, x) that is known up to an error e. The bound is the largest of the terms
// that apply:
//
//     rounding    the rounding of x, of f and of t, carried through the guard: Departure measures it
//     location    the movement of the guard within the resolution of the time: a root is located to
//                 a bracket of two resolutions, so its value there bounds this movement. A guard
//                 that jumps at its root has no such movement
//     value       a guard that counted as zero until now, or that a commit put there, is as far from
//                 zero as its value says
//     tolerance   the error of the method, where the guard leaves zero along the surface, so slowly
//                 that this error exceeds the other terms before the guard does: Departure carries
//                 the tolerances through the guard
//
// The flow is asked within the first three; a decision may add the fourth.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// The term by location of a guard with this value at its root.
inline double location_error(double g_at_root, bool jumped) {
  return jumped ? 0.0 : thresholds::location_error * std::abs(g_at_root);
}

/// The parts of the error of a guard that are known before the flow is asked.
struct ErrorFacts {
  double g = 0.0;               ///< its value
  double location = 0.0;        ///< the term by location, of a guard that fired; 0 where it jumped
  bool fired = false;           ///< in this instant
  bool left_error = false;      ///< it fired on leaving its error, and did not jump
  bool counts_as_zero = false;  ///< it waits, its mode was entered, or a commit put it at zero
};

/// The bound before the flow is asked.
///
///     fired, was clearly off zero     location: 0 where it jumped
///     fired on leaving its error      its value, and one part in a hundred for the rounding of the
///                                     reset: bounds made from bounds would grow without end
///     counts as zero                  its value
///     otherwise                       0
inline double error_so_far(const ErrorFacts& facts) {
  const double value = std::abs(facts.g);
  if (facts.fired) return facts.left_error ? thresholds::kept_error * value : facts.location;
  return facts.counts_as_zero ? value : 0.0;
}

/// The bound of the guard of a block at rest: all terms that apply. A guard that jumped at its root
/// has a value on each side of the jump, and the block may rest a rounding beside it on either side:
/// both count as zero.
inline double contact_error(double rounding, double value, double before, double jump = 0.0) {
  return std::max({rounding, std::abs(value) + jump, before});
}

}  // namespace saltus
