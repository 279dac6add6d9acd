// The tuning numbers of CVODE and its start: name, unit and derivation or source. Where a test is
// named, it fails if the number is a hundred times as large, or as small.
#pragma once

namespace saltus::thresholds {

// --- CVODE: cvode_solver.cpp, cvode_scene.hpp

/// [1] From this rtol on BDF gets a smaller part of the tolerance, and of what Newton's iteration
/// may leave of it [CVODE's unit, 0.1 otherwise]: the local errors of its low orders have one sign,
/// and at rtol 1e-3 they add up to 1 to 11 tolerances in twenty steps. tests/python/scipy_ivp
inline constexpr double loose_rtol = 1e-3, loose_share = 0.5, loose_newton = 0.01;
/// [first steps of CVODE] If the next event may follow within these, a one-step method starts: a
/// step of order 1 would draw the flight as a line. tests/unit/cvode_start_test.cpp
inline constexpr double one_step_flight = 2e4;
/// [horizons] CVODE takes over after these. tests/unit/cvode_start_test.cpp
inline constexpr double start_horizons = 4.0;
/// [eps |t|] and [s]: CVODE takes no step within a few roundings of the time, nor below the least
/// double of full precision. tests/unit/cvode_start_test.cpp
inline constexpr double cvode_roundings = 64.0, cvode_shortest = 1e-290;
/// [time constants of the fastest part] A flight of more is left to BDF. An explicit method would
/// need more than 60 steps for it at its limit of stability, 3.25; BDF starts in 13 to 27.
/// tests/unit/cvode_start_test.cpp
inline constexpr double stiff_flight = 200.0;
/// [steps] that have to advance by as many roundings of the time, if each is shorter than
/// `least_step_roundings` of them. The jumps of Van der Pol with mu = 1e6 take steps of ten
/// roundings. tests/unit/progress_test.cpp
inline constexpr int watched_steps = 100;
/// [steps] of order 1 after CVODE's start. tests/unit/cvode_start_test.cpp
inline constexpr int coarse_steps = 2;
/// [failures] of Newton's iteration in one step; CVODE's own ten are too few for a stiff contact.
/// tests/laws/crawl_test.cpp (half as large)
inline constexpr int convergence_failures = 20;
/// [1] CVODE multiplies values to compare signs: nothing that it sees may underflow then.
/// tests/unit/cvode_start_test.cpp (if its square underflows)
inline constexpr double least_shown = 1e-100;
/// [states] The general vector operations are as fast from here on.
/// tests/unit/contraction_test.cpp
inline constexpr int small_vector = 16;

// --- Adams' corrector: contraction.hpp; q is the ratio of two changes of its iteration

/// [q] A step whose iteration is slower is refused: up to 1/3 the iteration leaves at most half of
/// its last change. tests/unit/contraction_test.cpp
inline constexpr double slowest_ratio = 0.3;
/// [q] Above this the tolerance of the iteration shrinks as (fast_ratio / q)^3 (1 - q). It is the
/// usual q of scenes whose steps are bounded by their accuracy (Kepler, Lorenz, Pleiades).
/// tests/unit/contraction_test.cpp
inline constexpr double fast_ratio = 0.1;
/// [tolerances of the iteration] Smaller changes are not judged: the iteration is over.
/// tests/unit/contraction_test.cpp
inline constexpr double judged_change = 0.01;
/// [1] CVODE's own memory of q from change to change, CRDOWN. tests/unit/contraction_test.cpp
inline constexpr double ratio_memory = 0.3;

// --- fast parts that are hardly damped: hardly_damped.hpp

/// [h |lambda|] BDF follows a slower part: a twelfth of a period. It damps a faster one: the regions
/// where orders 3 to 5 amplify end at 2, 5 and 10 on the imaginary axis.
/// tests/unit/hardly_damped_test.cpp
inline constexpr double followed_reach = 0.5, damped_reach = 12.0;
/// [of the steps] that the convergence of Adams' corrector has shortened: 0.25 to 0.5 beside fast
/// modes (+- 30i, 300i, a clamped beam), at most 0.06 where accuracy bounds the steps (Kepler, an
/// oscillator; rtol 1e-3 to 1e-8). tests/unit/hardly_damped_test.cpp
inline constexpr double bounded_share = 0.12;
/// [1] The damping ratio up to which the errors of a part may add up: an estimate for many modes,
/// those of a beam, is 0.16. tests/unit/hardly_damped_test.cpp
inline constexpr double undamped = 0.3;
/// [steps] until the first look; each later one is after twice as many. [looks] that have to show
/// such a part. tests/unit/hardly_damped_test.cpp
inline constexpr int first_look_of_doubt = 32, looks_of_doubt = 2;

}  // namespace saltus::thresholds
