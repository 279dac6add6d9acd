// The tuning numbers of the solvers: name, unit and derivation or source. Where a test is named, it
// fails if the number is a hundred times as large, or as small. No test holds short_share.
// Coefficients of a method, and its bounds of step factors, are in dopri5.hpp and dop853.hpp.
#pragma once

#include <limits>

#include "saltus/base/view.hpp"

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
/// [min_minor_step_size] A step of this length is at the lower bound, but for rounding.
/// tests/unit/step_size_test.cpp
inline constexpr double at_min_step = 1.01;

// --- dense output of dop853: runge_kutta.hpp

/// [tolerances] The error allowed for a look inside a step: less than half of the ten tolerances
/// that the tests allow for the time of an event. tests/unit/halves_test.cpp
inline constexpr double dense_room = 4.0;

// --- location: narrow.hpp, locate.hpp, glance.hpp

/// [eps of the offset] The bracket of a root: the offsets at its ends differ by two roundings.
/// tests/unit/narrow_test.cpp
inline constexpr double bracket_roundings = 2.0;
/// [brackets] In a shorter interval there is one point to look at only, its middle.
/// tests/errors/chattering_errors_test.cpp (as small)
inline constexpr double last_look = 3.0;
/// [looks] Bisection takes 53 looks; where an estimate has not come to an end by then, bisection
/// goes on. The second number is a limit that neither reaches: 60 and the 74 + 53 halvings of an
/// interval down to the least double. tests/unit/narrow_test.cpp, tests/unit/locate_cvode_test.cpp
inline constexpr int bisects_after = 60, most_looks = 200;
/// [1] Growth of the steps back from a zero on a plateau: each look gains three of 53 bits.
/// tests/unit/narrow_test.cpp
inline constexpr double plateau_growth = 8.0;
/// [1] Where at most one in so many guards has crossed, only these are narrowed. The two looks at
/// all others at the end then cost less than is saved. tests/unit/narrow_test.cpp
inline constexpr std::size_t few_guards = 8;
/// [of the guard at the bracket's ends] Rounding of the interpolant at a root: both ends may be off
/// by as much as they differ, twice. tests/unit/narrow_test.cpp, tests/unit/found_root_test.cpp
inline constexpr double root_noise = 4.0;
/// [1] How much steeper than in the whole interval a guard has to be in its last bracket to be a
/// jump. A bracket is narrowed by 1e12 and more: a jump is steeper by the whole factor, a smooth
/// guard hardly. This lies between, in decades. tests/semantics/guards_jump_test.cpp fails where it
/// is so large that nothing is a jump.
inline constexpr double jump_steepness = 1e6;
/// [points] in a step of an interpolant of lower degree.
/// tests/semantics/zeno_moving_frame_test.cpp
inline constexpr int least_scan_points = 3;
/// [of a piece of a step] The first look after a restart where a guard is beyond zero: with the
/// looks at both ends of the first piece it shows whether the guard comes back inside it.
/// tests/semantics/guards_behind_test.cpp
inline constexpr double first_look = 1.0 / 64.0;
/// [of the interval] A root so near to its begin gives no look that a parabola could use.
inline constexpr double short_share = 1e-3;
/// [eps t] and [of the interval]: how far after its root a monitor is looked at for its side.
/// tests/laws/tangent_pairs_test.cpp
inline constexpr double leave_roundings = 64.0, leave_share = 1e-9;
/// [steps] Looks inside steps that need none: the first after seven, then 15, 31, 63.
/// tests/unit/locate_test.cpp
inline constexpr int least_patience = 7, most_patience = 63;
/// [1] A guard is out of reach if it could not come to zero and back at this many times its recent
/// speed: two for the way, four for a change of speed. tests/unit/glance_test.cpp
inline constexpr double speed_margin = 8.0;
/// [1] Part of the recent speed that is kept from look to look. tests/unit/glance_test.cpp
inline constexpr double speed_memory = 0.5;
/// [of the largest of three looks] The vertex of a parabola above this is no dip worth a look.
/// tests/unit/dip_search_test.cpp
inline constexpr double shallow_dip = 0.25;
/// [of the middle look] A vertex above this brings the minimum no nearer to zero.
/// tests/unit/dip_search_test.cpp
inline constexpr double slow_dip = 0.5;
/// [of the largest of three looks] A touch of zero within this is rounding, no dip.
/// tests/unit/dip_search_test.cpp
inline constexpr double dip_rounding = 1e-12;
/// [looks] at the vertex: each has twice as many digits as the one before; 2^6 > 53.
/// tests/laws/tangent_pairs_test.cpp
inline constexpr int dip_looks = 6;

// --- guards that vary faster than the state: look_pace.hpp

/// [errors of the parabola] A guard that is nearer to zero than so many may have crossed it unseen:
/// the error is estimated from one third difference, which another place of the piece may exceed.
/// tests/unit/look_pace_test.cpp
inline constexpr double hidden_room = 4.0;
/// [of the range of four looks] A parabola whose error is less shows the guard. That of a sine is
/// when there are twelve looks in a period. tests/unit/look_pace_test.cpp
inline constexpr double hidden_share = 1.0 / 32.0;
/// [errors of the parabola] and [of hidden_share] The error grows eight times as the piece grows
/// twice: both have this room, and a factor of two. tests/unit/look_pace_test.cpp
inline constexpr double growth_room = 64.0, slow_share = 1.0 / 16.0;
/// [of an evenly spaced piece] A shorter piece is not halved: of a guard with some hundred periods
/// in a step each crossing is found. tests/unit/look_pace_test.cpp
inline constexpr double finest_piece = 1.0 / 256.0;
/// [eps t] Looks nearer to each other would hardly be at different times.
/// tests/laws/crossings_test.cpp (as small)
inline constexpr double look_roundings = 4.0;
/// [pieces] The second of the three looks that begin a run: the golden ratio, which is far from each
/// ratio of small numbers. tests/laws/fast_guards_test.cpp
inline constexpr double uneven = 1.6180339887498949;
/// [of a piece] How far two looks are apart whose difference is a derivative: its error, this part of
/// the second derivative, and its rounding, eps by this part, are both far below its size.
/// tests/laws/fast_guards_test.cpp
inline constexpr double near_share = 1e-6;
/// [ranges of four looks] A guard that would move further in a piece, at its first derivative, turns
/// between the looks: a parabola moves by at most two ranges. tests/laws/fast_guards_test.cpp
inline constexpr double steep_ranges = 2.0;
/// [pieces] in one step that are as short as allowed and do not show a guard: it then counts no more
/// for 63 steps. tests/unit/look_pace_test.cpp
inline constexpr int most_in_vain = 16;

// --- many monitors at once: crowd_locator.hpp, guard_polynomials.hpp

/// [crossings] in one interval. Locating a few of them one by one takes as many looks as the
/// polynomials do. tests/unit/crowd_locator_test.cpp
inline constexpr std::size_t crowd_size = 8;
/// [eps |t|] In a shorter interval the points of a polynomial would hardly be different times.
/// tests/unit/crowd_locator_test.cpp
inline constexpr double crowd_roundings = 1e3;
/// [eps] of the time and of the step: how far after its crossing one may be noted. The contract
/// allows a hundred. tests/unit/crowd_locator_test.cpp
inline constexpr double crossing_roundings = 16.0;
/// [errors of the polynomial] A monitor is at zero within these after it has passed: its value is
/// off by one on either side, at the crossing and at the next look.
/// tests/unit/crowd_locator_test.cpp
inline constexpr double passed_error = 4.0;
/// [eps of the largest value] Rounding of the barycentric formula, whose thirteen terms are each
/// rounded a few times; the sum of their weights is 1. tests/unit/guard_polynomials_test.cpp
inline constexpr double formula_roundings = 8.0;
/// [of the largest of the last three coefficients] The terms that a polynomial leaves out, if
/// coefficients fall by a quarter or more from one to the next: 1 / (1 - 3/4).
/// tests/unit/guard_polynomials_test.cpp
inline constexpr double omitted_terms = 4.0;
/// [roundings of the formula] From here on a shorter interval helps: halving it divides what is
/// left out by 2^13. tests/unit/guard_polynomials_test.cpp
inline constexpr double truncated_roundings = 64.0;
/// [of the interval] The slope at a root is that over this much to either side. The difference has
/// eleven digits there, and the change of the slope is of this order.
/// tests/unit/guard_polynomials_test.cpp (as large)
inline constexpr double slope_share = 1e-4;

// --- stiffness of an explicit method: stiffness.hpp

/// [steps] in a row that look stiff, and steps that do not and end the row (the code DOPRI5).
/// tests/unit/stiffness_test.cpp
inline constexpr int stiff_steps = 15, other_steps = 6;
/// [1] h |lambda| below which no step looks stiff. tests/unit/stiffness_test.cpp
inline constexpr double least_reach = 0.25;
/// [of h |lambda|] A step whose derivative turns by less is short because of stability.
/// tests/unit/stiffness_test.cpp
inline constexpr double smooth_turn = 0.1;
/// [1] BDF's step on a smooth solution is this times rtol^(1/6) h / r (two modes of bench/methods,
/// rtol 1e-3 to 1e-12); [calls] of a step of BDF; [1] the part of our calls that BDF has to save.
/// tests/unit/stiffness_test.cpp
inline constexpr double bdf_step = 0.4, bdf_calls = 1.5, saved_calls = 0.5;

/// [steps] until the next question at most, after returns that did not last.
/// tests/unit/stiffness_test.cpp
inline constexpr int latest_question = 100000;
/// [of the size of a state] An oscillation up to this amplitude may be one of the errors.
/// tests/laws/fast_modes_test.cpp (as small)
inline constexpr double part_of_solution = 0.3;

// --- spectral radius: spectral_radius.hpp

/// [1] Part of every other direction that an iteration starts with; [iterations], for an order of
/// magnitude. tests/unit/spectral_radius_test.cpp
inline constexpr double other_directions = 0.1;
inline constexpr int power_iterations = 3;
/// [iterations] at most, where many oscillations take part. [sine of the angle between two vectors]
/// The part that the fit of one pair may leave unexplained; [cosine] of the angle by which many
/// turn a vector back. tests/unit/spectral_radius_test.cpp
inline constexpr int most_power_iterations = 15;
inline constexpr double unexplained_turn = 0.1, turned_back = 0.9;

// --- "auto": choose.cpp, auto_solver.hpp

/// [1] rtol below which dop853 takes less time than dopri5 at equal rtol (bench/methods). Ratios of
/// the times for Kepler, Arenstorf, Van der Pol with mu = 1: 0.8 at 1e-6, 0.5 to 0.9 at 1e-7, 0.3
/// at 1e-12. tests/unit/auto_solver_test.cpp
inline constexpr double order_8_pays = 1e-7;
/// [1] The same with guards that stop. Ratios for a ball with drag, whose flights end inside a step
/// and whose steps need looks inside: 1.6 at 1e-9, 1.0 at 1e-10, 0.8 at 1e-12.
/// tests/unit/auto_solver_test.cpp
inline constexpr double order_8_pays_with_guards = 1e-10;
/// [states] Up to which Radau takes less time than BDF at equal rtol: 0.6 to 1.2 of it at 3 to 20
/// states, 1.5 at 32. tests/unit/stiff_choice_test.cpp
inline constexpr double few_for_radau = 16.0;
/// [1] rtol from which on BDF's errors are more than ten tolerances on most stiff scenes of the
/// shelf. tests/unit/stiff_choice_test.cpp
inline constexpr double tight_for_bdf = 1e-7;
/// [ns] of a factorisation per state, beyond which Radau takes more than five times BDF's time: a
/// full matrix of 120 states. tests/unit/stiff_choice_test.cpp
inline constexpr double dear_matrices = 1000.0;
/// [steps] An event that ends a stretch of BDF sooner finds it at a low order; [stretches] of this
/// kind in a row, until events count as frequent. tests/unit/auto_solver_test.cpp
inline constexpr int brief_stretch = 30, brief_stretches = 3;
/// [1] The damping ratio up to which a part oscillates: its bound by stability is nearer to that of
/// the imaginary axis (dopri5: 1.0, 1.4, 1.9, 2.7, 3.2 at ratios 0, 0.001, 0.01, 0.1, 0.3); and the
/// rounding of a ratio that differences have given. tests/laws/fast_modes_test.cpp
inline constexpr double hardly_damped = 0.3, damping_rounding = 1e-3;
/// [tolerances] Amplitude up to which a fast oscillation counts as excited by errors (dopri5 beside
/// modes that the solution does not excite: 10 to 15). tests/laws/fast_modes_test.cpp
inline constexpr double damped_size = 20.0;
/// [1] rtol up to which none is damped by longer steps. tests/laws/fast_modes_test.cpp
inline constexpr double tight_for_damping = 1e-7;
/// [1] The damping ratio from which on a part does not swing. tests/laws/fast_modes_test.cpp
inline constexpr double well_damped = 0.9;
/// [1] h |lambda| below which the steps of BDF are stable for the explicit method (L. Petzold, SIAM
/// J. Sci. Stat. Comput. 4 (1983) 136), and below which those of Radau cost as many calls.
/// tests/unit/auto_solver_test.cpp
inline constexpr double stable_reach = 1.0, stable_reach_of_radau = 3.0;
/// [of the steps before] A first step shorter than this looks stiff, if also h |lambda| of the
/// steps before was beyond ten times the bound of stability, and that of this step is not below
/// `least_reach`. tests/unit/stiff_signs_test.cpp
inline constexpr double collapse = 0.01, far_beyond_stability = 10.0;
/// [steps] of BDF and of Radau between two checks; [checks] in a row that must succeed, at first
/// and at most. tests/unit/auto_solver_test.cpp
inline constexpr int check_every = 50, check_every_of_radau = 25;
inline constexpr int first_checks = 2, most_checks = 64;
/// [steps] A stretch of BDF or Radau begins with as many steps that do not count, because order and
/// steps rise; an explicit stretch that ends sooner did not last. tests/unit/auto_solver_test.cpp
inline constexpr int short_stretch = 100, short_stretch_of_radau = 25;

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

// --- Jacobian and sparsity: jacobian.cpp, probe.cpp, find_places.cpp

/// [roundings of f] The least change of f that a difference is made of (CVODE's own).
/// tests/unit/jacobian_test.cpp
inline constexpr double difference_roundings = 1000.0;
/// [1] Part of a change of f that a Jacobian may leave unexplained: what differences leave of it,
/// and [eps] the rounding of f. tests/unit/jacobian_test.cpp
inline constexpr double unexplained = 0.01, unexplained_roundings = 100.0;
/// [states] A smaller block counts as full: its Jacobian by differences costs no more calls than a
/// search. tests/unit/probe_test.cpp
inline constexpr Index small_block = 256;
/// [sizes of the states] Distance of the two points that places are looked for at.
/// tests/unit/probe_test.cpp
inline constexpr double near_point = 1e-4, far_point = 1e-2;
/// [groups] from which a half full matrix ends the search; [colours] above which a round is too
/// expensive. tests/unit/find_places_test.cpp
inline constexpr Index judged_groups = 64, most_colours = 1000;

// --- linear solvers: linear/ (times fitted to bench/linear_solvers; only where they cross matters)

/// [states] Up to here a full matrix is never slower. tests/unit/linear_solver_test.cpp
inline constexpr Index few_states = 8;
/// [diagonals] Up to here no other order is looked for. tests/unit/linear_solver_test.cpp
inline constexpr Index narrow_band = 8;
/// [1] A new order of the states must make the band narrower than this part.
/// tests/unit/linear_solver_test.cpp
inline constexpr double band_pays = 0.8;
/// [ns] per n^3 and n^2 of a factorisation and its solves. tests/unit/linear_solver_test.cpp
inline constexpr double dense_cube = 0.06, dense_square = 3.0;
/// [ns] per row, per row and diagonal, per row and product of diagonals.
/// tests/unit/linear_solver_test.cpp
inline constexpr double band_row = 20.0, band_diagonal = 2.0, band_product = 0.15;
/// [ns] per row, entry of the factors, and operation. tests/unit/linear_solver_test.cpp
inline constexpr double sparse_row = 300.0, sparse_entry = 15.0, sparse_operation = 1.0;
/// [ns] per place; three times the measured time, because the number of iterations is not known
/// beforehand. tests/unit/linear_solver_test.cpp
inline constexpr double gmres_place = 3.0 * 150.0;
/// [entries] of a factor, at which their count stops: 0.3 s of a factorisation.
/// tests/unit/preconditioner_test.cpp
inline constexpr double most_factor_entries = 2e7;
/// [states] Up to here elimination is unrolled, without vectors: 0.4 of the time for four states,
/// 0.9 for eight; more states do not unroll. Eigen's blocks are faster from `large_dense` on
/// (bench/factorisations). tests/unit/factorisation_test.cpp
inline constexpr int unrolled_dense = 8;
inline constexpr Index large_dense = 48;
/// [states] Up to here the Jacobian is renewed with each set-up, and a set-up made each five steps:
/// see LinearSystem::refresh_often. tests/laws/fast_modes_test.cpp fails with five hundred steps.
inline constexpr Index fresh_jacobian = 16;
inline constexpr int setup_steps = 5;
/// [vectors] of GMRES's Krylov space, at most. tests/unit/linear_solver_test.cpp
inline constexpr int krylov_vectors = 20;
/// [1] Smaller entries of a row are dropped from the incomplete factorisation (Eigen's ILUT).
/// tests/unit/preconditioner_test.cpp
inline constexpr double dropped = 1e-3;
/// [times] that a search may find new places before it is given up. tests/unit/probe_test.cpp (as
/// small)
inline constexpr int most_renewals = 20;

}  // namespace saltus::thresholds
