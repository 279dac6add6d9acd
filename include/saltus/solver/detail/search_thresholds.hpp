// The tuning numbers of the search for crossings inside a step: name, unit and derivation or
// source. Where a test is named, it fails if the number is a hundred times as large, or as small.
// No test holds short_share.
#pragma once

#include <cstddef>
#include <cstdint>

namespace saltus::thresholds {

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
/// jump. Most brackets are narrowed by 1e12 and more: a jump is steeper by the whole factor, a smooth
/// guard hardly. This lies between, in decades. tests/semantics/guards_jump_test.cpp fails where it
/// is so large that nothing is a jump.
inline constexpr double jump_steepness = 1e6;
/// [1] The same where an interval is narrowed less: this power of the factor, between that of a cube
/// root, 2/3, and that of a jump, 1. An interval that is narrowed by less than a thousand says nothing.
/// tests/unit/narrow_test.cpp
inline constexpr double jump_power = 0.75, jump_narrowing = 1e3;
/// [eps |t|] A root so near to a stop is at the stop: some times the rounding of a time, and that of a
/// state by which it was located. tests/semantics/instant_ties_test.cpp (as small)
inline constexpr double stop_roundings = 64.0;
/// [of its last move, of the step] A guard that is nearer to zero at a stop may be there by rounding, and so
/// may a root that is nearer to the end of its step: the rounding of a state is less than this part of a
/// move that is 1e-11 of it. tests/unit/locate_test.cpp
inline constexpr double beside_stop = 1e-4;
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
/// [1] Growth of that distance while the monitor is within its rounding: each look gains three of
/// the thirty bits of the interval. tests/laws/close_pairs_test.cpp (as small)
inline constexpr double leave_growth = 8.0;
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
/// [of the last look] A vertex above this brings the minimum no nearer to zero.
/// tests/unit/dip_search_test.cpp
inline constexpr double slow_dip = 0.5;
/// [of the largest of three looks] A touch of zero within this is rounding, no dip.
/// tests/unit/dip_search_test.cpp
inline constexpr double dip_rounding = 1e-12;
/// [places] on the way to the least value: each has 1.6 times the digits of the one before, from one
/// or two at the vertex of the parabola; 1.6^6 > 16.
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
/// [1] How much better than a guard a value has to be shown that guards read: there are 30 looks in a
/// period of a sine. tests/unit/piece_judge_test.cpp
inline constexpr double read_room = 16.0;
/// [eps of a value] that guards read: what a formula of some operations is off by.
/// tests/unit/piece_judge_test.cpp (as small)
inline constexpr double read_roundings = 8.0;
/// [of an evenly spaced piece] A shorter piece is not halved: of a guard with a million periods in a
/// step each crossing is found. tests/unit/look_pace_test.cpp
inline constexpr double finest_piece = 0x1p-24;
/// [of an evenly spaced piece] Four looks this near to each other show a guard of two values: shorter
/// pieces would show its one jump no better. tests/unit/piece_judge_test.cpp
inline constexpr double step_piece = 1.0 / 256.0;
/// [eps t] Looks nearer to each other would hardly be at different times.
/// tests/laws/crossings_test.cpp (as small)
inline constexpr double look_roundings = 4.0;
/// [1] How much further apart than before the looks of a step may be, before the guards are looked at
/// as in the first step. A sine that is slow has 24 looks in a period; three in a period, at eight
/// times the distance, still show that it is fast. tests/unit/look_pace_test.cpp
inline constexpr double known_growth = 8.0;
/// [1] How much longer than the last step that was looked into a step may be that passes without a look
/// inside, where a guard follows the time. A sine that is slow has 24 looks in a period, so that the step
/// of six looks that showed it is a quarter of a period, and the next one half of it.
/// tests/unit/look_pace_test.cpp
inline constexpr double seen_growth = 2.0;
/// [of an evenly spaced piece] How far two times are apart at which a called function is asked whether it
/// follows the time, with one state: many roundings of the time, and a small part of the way to a time
/// at which that state would be impossible. tests/laws/timed_guards_test.cpp
inline constexpr double times_apart = 1.0 / 64.0;
/// [eps of the largest value] that the sum of a step and its interpolant, or a guard, may be off by where they
/// are on a line. tests/unit/line_states_test.cpp
inline constexpr double line_roundings = 64.0;
/// [of these] A state that moves by less may be at rest, and its rounding a line.
/// tests/unit/line_states_test.cpp
inline constexpr double line_moves = 64.0;
/// [pieces] The second of the three looks that begin a run: the golden ratio, which is far from
/// each ratio of small numbers. tests/laws/fast_guards_test.cpp
inline constexpr double golden_ratio = 1.6180339887498949;
/// [of a piece] The middle one of three points at which a state moves on a line, so that no sine of a short
/// period has the same value at all three. tests/unit/line_states_test.cpp
inline constexpr double line_share = golden_ratio - 1.0;
/// [of the time since a guard crossed] How far apart looks may be where a guard follows the time: four of them
/// are in a time half as long, in which it may be fast again. tests/laws/modulated_guards_test.cpp
inline constexpr double slow_time = 1.0 / 8.0;
/// [periods] How far apart looks may be at a guard by a sine of the time whose period is known. Four of them
/// are in half a period, so that their third difference shows the sine, whatever its amplitude was before.
/// tests/laws/resting_waves_test.cpp (as large)
inline constexpr double wave_share = 1.0 / 8.0;
/// [of a piece] How much shorter pieces are at most, where there is more than one: it costs an eighth of the looks.
/// tests/laws/modulated_guards_test.cpp (as small)
inline constexpr double uneven_part = 0.25;
/// [of a piece] How far two looks are apart whose difference is a derivative: its error, this part
/// of the second derivative, and its rounding, eps by this part, are both far below its size.
/// tests/laws/fast_guards_test.cpp
inline constexpr double near_share = 1e-6;
/// [ranges of four looks] A guard that would move further in a piece, at its first derivative,
/// turns between the looks: a parabola moves by at most two ranges. tests/laws/fast_guards_test.cpp
inline constexpr double steep_ranges = 2.0;
/// [pieces] in one step that are as short as allowed and do not show a guard, or that seem to show
/// noise in a row: it then counts no more for 63 steps. tests/unit/look_pace_test.cpp
inline constexpr int most_in_vain = 16;

// --- edge_detection of a value that varies all the time: edge_series.hpp

/// [eps of the value] A guard that has changed by less varies by its rounding: the operands of a
/// difference have one each, and so has the difference. tests/unit/edge_series_test.cpp
inline constexpr double edge_roundings = 4.0;
/// [eps |t|] and [of the step]: firings that follow each other within this time. A root is located to some
/// roundings of the time; a step with ten million firings would take longer than a run may.
/// tests/unit/edge_series_test.cpp
inline constexpr double edge_gap = 1e3, edge_share = 1e-7;
/// [firings] So many in a row are without end: more than a staircase has by chance.
/// tests/unit/edge_series_test.cpp
inline constexpr std::int64_t endless_edges = 1000;

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

}  // namespace saltus::thresholds
