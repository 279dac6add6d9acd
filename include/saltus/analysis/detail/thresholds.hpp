// Every number that the searches are tuned with.
#pragma once

#include <limits>

namespace saltus {

/// The relative rounding of a double, as tests/unit/least_squares_test.cpp counts errors.
inline constexpr double unit_rounding = std::numeric_limits<double>::epsilon();

// --- least squares: tests/unit/least_squares_test.cpp ---
/// Of the first step: one Gauss-Newton step nearly, where the columns are of length 1.
inline constexpr double first_damping = 1e-3;
/// The damping of a step at most: it is far shorter than a rounding of x.
inline constexpr double most_damping = 1e20;
/// After refusals the damping is at least this, so that it grows in a few steps.
inline constexpr double least_damping = 1e-8;
inline constexpr double most_growth = 64.0;
/// A good step divides the damping by ten: the convergence is then faster than linear.
inline constexpr double shrinks_by = 0.1;
/// The part of the predicted reduction that a step has to have (More 1978 takes 1e-4).
inline constexpr double least_reduction = 1e-4;

// --- operating points: tests/laws/trim_test.cpp ---
/// [of the unit of an unknown] its rounding: an unknown whose solution is 0 comes out as some 1e-17
/// beside others of size 1.
inline constexpr double unknown_noise = 1e-12;
/// [of the largest singular value] a smaller one is zero: exact derivatives have an error of 1e-15
/// of their terms, central differences of 1e-10.
inline constexpr double rank_of_point = 1e-8;
/// [of the unit of an unknown] the distance of a second point, which shows what a curvature does. At
/// a double root the Jacobian is as small as the error of the root, near 1e-8.
inline constexpr double beside_point = 1e-6;
/// [of the largest entry of A] a real part below it has no sign: a double eigenvalue has an error of
/// the square root of the rounding.
inline constexpr double pole_margin = 1e-7;
/// [of the largest entry of a null vector] smaller entries are rounding.
inline constexpr double null_part = 1e-6;
/// [of the unit of a value] the distance from a bound at which a value is said to be there.
inline constexpr double close_to_bound = 1e-6;
/// Roundings of each term of a rate or an output.
inline constexpr double roundings_of_term = 16.0;
/// Newton steps at the end of a search: a simple root needs some three.
inline constexpr int last_newton_steps = 20;
/// [of the largest pivot] a smaller one is zero in a Newton step: it moves nothing.
inline constexpr double newton_rank = 1e-10;
/// [of the size of a value] two searches that end at one point end closer than this.
inline constexpr double same_point = 1e-6;

// --- orbits: tests/laws/orbits_test.cpp ---
/// The first span in which firings are looked for is the longest one, halved this often.
inline constexpr int first_halvings = 16;
inline constexpr double span_growth = 2.0;
/// The next search looks this far: as far as the last firing, and a little beyond.
inline constexpr double span_beyond = 1.01;
/// Part of the period between the firing and the start: far more than the error of the time of a
/// firing, so that a run to the start has seen it, and far less than the scale of the flow.
inline constexpr double section_delay = 1e-6;
inline constexpr double most_section_delay = 1e-2;
/// Part of the period by which a check shifts the time: no simple fraction of that of a drive.
inline constexpr double elsewhere = 0.381966;
/// The part of the size of the states, times the growth in a period, by which two runs may differ.
inline constexpr double same_run = 1e-6;
/// What the values of a state whose size is zero may differ by: ten times the default atol.
inline constexpr double same_at_zero = 1e-11;
/// The part of a parameter by which a check of the drive moves it.
inline constexpr double drive_part = 1e-3;
/// A Newton step may change the first guess of the period by this factor, not more: towards zero all
/// states return.
inline constexpr double period_range = 4.0;
/// Values of a span that are looked at for a return.
inline constexpr int return_looks = 4000;
/// A return to within this part of the size of the motion is one.
inline constexpr double return_near = 0.1;
/// [of the longest period] the first span that is looked at, and its growth.
inline constexpr double first_return_look = 1.0 / 65536.0;
inline constexpr double return_growth = 4.0;
/// The shortest part of a Newton step that is tried.
inline constexpr double least_newton_part = 1.0 / 4096.0;
/// Returns that are followed until all modes and labels are as they were.
inline constexpr int most_first_returns = 8;
/// Singular values below this part of the largest are errors of the derivatives, near 1e-9.
inline constexpr double newton_singular = 1e-8;
/// Tolerances below which a Newton step is the error of the runs, and no step helps any more.
inline constexpr double newton_noise = 1e3;
/// The error of the trivial multiplier above which a note says it; that of a run is near 1e-8.
inline constexpr double trivial_off = 1e-5;
/// The smallest singular value of M - 1, as part of the norm of M, below which a multiplier is 1: a
/// double one may be further from 1 by the square root of the errors of M.
inline constexpr double multiplier_one = 1e-6;
/// The distance from the unit circle that has no sign: a double multiplier, as of a conservative
/// system, has an error of the square root of that of the derivatives, near 1e-9.
inline constexpr double multiplier_margin = 1e-4;
/// [of the size of a state] a point that returns to itself within this is a fixed point.
inline constexpr double closed_point = 1e-6;

// --- exponents: tests/laws/exponents_test.cpp ---
/// Pieces at least, so that the batches of the standard errors have some each.
inline constexpr int least_pieces = 200;
/// A relative growth over the whole time that the errors of the derivatives hide.
inline constexpr double resolved_growth = 1e-6;
/// The numbers of batches whose largest standard error is taken: longer batches are less dependent
/// on each other, more of them are known better.
inline constexpr int batch_counts[] = {8, 16, 32};
/// Ends that are tried for one piece.
inline constexpr int piece_tries = 8;
/// The part of the time in which the directions only turn towards their own ones.
inline constexpr double aligned_part = 0.1;
/// ln 1e3: by how much two directions may grow apart in a piece; the derivatives have an error of
/// 1e-9 to 1e-10 of the largest, so the smaller direction is known to 1e-6.
inline constexpr double wanted_apart = 6.907755278982137;
/// ln 1e6: beyond this a piece is divided.
inline constexpr double most_apart = 13.815510557964274;
/// Halvings of the longest piece. A direction that is lost in a piece that short is lost at an event:
/// the matrix of its jump is singular.
inline constexpr int most_divisions = 20;
inline constexpr double piece_growth = 2.0;
/// Directions grow apart by so little at least, in the choice of the next piece.
inline constexpr double least_apart = 1e-3;
/// The part of the time below which a rest of it is no piece.
inline constexpr double last_rest = 1e-9;

// --- fits: tests/laws/fits_test.cpp ---
/// The part of an undetermined direction above which a parameter takes part in it.
inline constexpr double open_part = 1e-3;
/// [of the slope of a loss] the second derivative that its quadratic model has at least: without one
/// an outlier would let a step go anywhere.
inline constexpr double least_curved = 0.1;
/// The cosine between the residuals and a column of the Jacobian below which they have no part along
/// it; ftol = 1e-8 ends a smooth fit below 2e-4.
inline constexpr double steep_cosine = 1e-2;
/// Relative steps down the gradient; a smooth cost changes a hundredth or less as much by the second
/// as by the first, a cost that jumps as much.
inline constexpr double jump_far = 1e-4, jump_near = 1e-6;
/// The part of a value at which a difference counts it as no smaller.
inline constexpr double least_scale = 1e-3;

}  // namespace saltus
