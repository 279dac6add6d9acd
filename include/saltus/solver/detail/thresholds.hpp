// The tuning numbers of the one-step methods: name, unit and derivation or source. Where a test is
// named, it fails if the number is a hundred times as large, or as small. Those of other subjects
// are in search_thresholds.hpp, stiff_thresholds.hpp, cvode_thresholds.hpp, linear_thresholds.hpp.
// Coefficients of a method, and its bounds of step factors, are in dopri5.hpp and dop853.hpp.
#pragma once

#include <limits>

namespace saltus::thresholds {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

// --- the next step: step_size.hpp, runge_kutta.hpp

/// [1] The step is this part of the step that the error estimate allows (Hairer, Wanner II, p. 28,
/// (2.43c)). tests/unit/step_size_test.cpp
inline constexpr double step_safety = 0.9;
/// [of beta] The part of the integral share beta that the proportional share gives up (the same
/// formula). tests/unit/step_size_test.cpp
inline constexpr double beta_of_exponent = 0.75;
/// [log2 of tolerances] The controller remembers no error below 1e-4 (the code DOPRI5).
/// tests/unit/step_size_test.cpp
inline constexpr double least_remembered = -13.287712379549449;
/// [tolerances] Below this error both powers together exceed the longest factor, so log2 is not
/// computed. That holds up to 1e-8: tests/unit/step_size_test.cpp
inline constexpr double negligible_error = 1e-9;
/// [1] The least factor after a rejection. The codes shorten to a tenth at most; after a change of
/// mode a thousandth may be right, which an error of 1e10 shows. tests/unit/step_size_test.cpp
inline constexpr double shortest_retry = 1e-3;
/// [1] The factor after an error that is not finite: the codes' most cautious.
/// tests/unit/step_size_test.cpp
inline constexpr double blind_retry = 0.1;
/// [eps |t|] A shorter step is an underflow: its twelve stages would hardly be different times.
/// tests/unit/locate_test.cpp
inline constexpr double least_step_roundings = 16.0;

// --- the first step: step_size.hpp (Hairer, Norsett, Wanner I, p. 169)

/// [tolerances] States that move by less until the end of the run rest.
/// tests/unit/step_size_test.cpp
inline constexpr double resting_change = 1e-5;
/// [of the run] Length of the trial step of states that rest. tests/unit/step_size_test.cpp
inline constexpr double resting_step = 1e-3;
/// [1] The trial step changes the states by this part; the first step's error is this part of a
/// tolerance. tests/unit/step_size_test.cpp
inline constexpr double first_change = 0.01;
/// [trial steps] The time in which the states change by themselves.
inline constexpr double time_of_change = 1.0 / first_change;
/// [eps |t|] The least first step, as CVODE's. tests/unit/step_size_test.cpp
inline constexpr double first_step_roundings = 100.0;

// --- when no step is small enough: step_size.hpp

/// [steps] and [eps |t|]: a value that is not finite within the larger of these ahead is the cause.
/// tests/unit/step_size_test.cpp
inline constexpr double ahead_steps = 16.0, ahead_roundings = 64.0;
/// [eps |t|] The tangent towards a derivative that is not finite. A step of `least_step_roundings`
/// may just have been tried in vain after one ten times (1 / `blind_retry`) as long, so the edge is
/// at most 160 roundings away; twice that.
/// tests/laws/domain_edges_test.cpp
inline constexpr double tangent_roundings = 320.0;
/// [min_minor_step_size] A step of this length is at the lower bound, but for rounding.
/// tests/unit/step_size_test.cpp
inline constexpr double at_min_step = 1.01;

// --- the error estimate of dop853: dop853.hpp

/// [e3^2 / m] The error of a step is 0.002 to 0.5 of it in the median of a scene (Kepler, Lorenz, Van
/// der Pol, a forced lag, a pendulum, fall with drag; rtol 1e-4 to 1e-10), and 9e-5 at least for a
/// plain integral of cos t. A smaller estimate is a coincidence, and a usual one counts. That is so
/// in a few of a hundred steps of one state. tests/laws/single_steps_test.cpp
inline constexpr double coincident_estimate = 8e-5, usual_estimate = 1e-2;

// --- dense output of dop853: runge_kutta.hpp

/// [tolerances] The error allowed for a look inside a step: less than half of the ten tolerances
/// that the tests allow for the time of an event. tests/unit/halves_test.cpp
inline constexpr double dense_room = 4.0;

}  // namespace saltus::thresholds
