// How CVODE starts: with steps of its own, or with those of a one-step method.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/solver/detail/cvode_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus::cvode {

/// Whether the next event may follow within so few first steps that a one-step method has to start.
/// A multistep method begins with order 1, and with steps so short that order 1 is within the
/// tolerance. It would draw a flight hardly longer than these steps as a line that falls from the
/// start, and the ball would fall through the floor (C. W. Gear, "Runge-Kutta starters for
/// multistep methods", ACM TOMS 6 (1980) 263).
inline bool is_event_near(double horizon, double first_step) {
  return horizon < thresholds::one_step_flight * first_step;
}

/// [s] Until when the one-step method runs, if the event does not come.
inline double start_ends(double t, double horizon) {
  return t + thresholds::start_horizons * horizon;
}

/// Whether a flight of `rest` [s] is long for an explicit method; `rate` [1/s] of the fastest part.
inline bool is_flight_stiff(double rate, double rest) {
  return rate * rest > thresholds::stiff_flight;
}

/// [s] CVODE takes no shorter step at a time of this size.
inline double shortest_step(double time) {
  return std::max(thresholds::cvode_roundings * thresholds::eps * time, thresholds::cvode_shortest);
}

/// Whether steps are still of order 1: a guard that was at zero when the stretch began may have a
/// false root there.
inline bool is_coarse(int steps) { return steps < thresholds::coarse_steps; }

}  // namespace saltus::cvode
