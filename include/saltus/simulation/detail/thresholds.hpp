// The tuning numbers of the instants of a run: name, unit and derivation. Where a test is named, it
// fails if the number is a hundred times as large, or as small.
#pragma once

#include <cstdint>
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus::thresholds {

// --- when a guard is at zero: departure.hpp, present.hpp, crossing_arming.cpp

/// [1] Relative disturbance of x, f and t by which the rounding of a guard is measured: far above
/// eps, so that the difference of two guards has eight digits, and so small that curvature, of
/// order 1e-14, shows in none of them. tests/unit/departure_test.cpp
inline constexpr double disturbance = 1e-7;
/// [eps] Rounding that a state carries after a step: a dozen stages, each with one rounding, and
/// the reset map. tests/unit/departure_test.cpp
inline constexpr double state_roundings = 16.0;
/// [eps |t|] Times closer than this may be the same time after a location; a flight of that length
/// does not differ from rest. tests/semantics/zeno_false_rest_test.cpp
inline constexpr double time_roundings = 64.0;
/// [eps |t|] Resolution of the location of a root: two roundings of the bracket, and those of t +
/// u. tests/semantics/guards_no_fall_test.cpp
inline constexpr double location_roundings = 8.0;
/// [of the guard's value at its root] Location error: Illinois leaves a bracket of two resolutions,
/// over which a guard doubles at most, and the flow adds as much again on the way back.
/// tests/unit/error_bound_test.cpp
inline constexpr double location_error = 4.0;
/// [of the guard's value] Error of a guard that fired on leaving its error: the old error, and one
/// part in a hundred for the rounding of the reset. tests/unit/error_bound_test.cpp
inline constexpr double kept_error = 1.01;
/// [of its movement by a commit] A guard that a commit moved further beyond zero than this part of
/// the whole movement is across: a rounding of that size would leave three digits.
/// tests/unit/pass_decisions_test.cpp
inline constexpr double clearly_across = 1e-3;
/// [tolerances of the states] A guard that leaves a falling surface is at zero within this error:
/// its distance grows as the third power of time, while the error of the state grows as the first.
/// tests/unit/departure_test.cpp
inline constexpr double lift_off_tolerances = 30.0;

// --- how far the flow is followed from a guard at zero: departure.hpp

/// [1] The time grows by this factor from look to look. Eight is a power of two: times stay exact.
/// tests/unit/departure_test.cpp
inline constexpr double look_growth = 8.0;
/// [of the range of the early looks] A parabola that is further from a value does not show a guard. That of
/// a sine is when they are half of a period. tests/unit/early_looks_test.cpp
inline constexpr double shown_share = 1.0 / 16.0;
/// [ranges of the early looks] A guard that would move further at its first slope turns between the looks:
/// a parabola moves by at most four. tests/unit/early_looks_test.cpp
inline constexpr double turning_ranges = 8.0;
/// [times] that the first time may be eight times shorter: 2^36. tests/laws/fast_effects_test.cpp (as small)
inline constexpr int shorter_times = 12;
/// [first looks] Time of the furthest look: six looks. The solver finds later events.
/// tests/unit/departure_test.cpp
inline constexpr double furthest_look = 3e5;
/// [of the run] Time of the first look at a guard that no state moves.
/// tests/semantics/zeno_false_rest_test.cpp
inline constexpr double first_look_of_run = 1e-9;
/// [of the run] A state that takes longer than this to move by its tolerance is ignored.
/// tests/unit/departure_test.cpp (as large)
inline constexpr double slow_state_of_run = 1e-3;
/// [of the largest move of the states] A guard that moves by this moves as the states do: its side
/// is beyond doubt, and its rounding need not be measured. tests/unit/departure_test.cpp (as large)
inline constexpr double doubtless_move = 1e-3;
/// [lift times] and [of the run]: the furthest look that waits for curvature to exceed rounding.
/// tests/unit/departure_test.cpp
inline constexpr double lift_times = 16.0;
inline constexpr double lift_of_run = 1e-2;
/// [s] A run that is shorter than this gives no time scale to look ahead by. [1] The time scale of
/// the fastest state is multiplied by this then. tests/unit/departure_test.cpp
inline constexpr double short_run = 1.0;
inline constexpr double short_run_looks = 1e9;
/// [first looks] The time over which the speed of a guard is bounded: long enough that its rounding
/// does not count, and short enough that no flow leaves its range. tests/unit/departure_test.cpp
inline constexpr double speed_looks = 1e6;
/// [of the difference of two slopes] The curvature that extrapolation leaves in the slope.
/// tests/unit/departure_test.cpp
inline constexpr double slope_noise = 1e-6;
/// [of the slope] A slope over half of the time that differs by less agrees with it.
/// tests/unit/departure_test.cpp
inline constexpr double slope_agrees = 0.5;
/// [of the fourth difference] The movement of a guard whose slope is sure: the difference has eight
/// roundings of a value at random, the movement four. tests/unit/departure_test.cpp
inline constexpr double above_noise = 10.0;
/// [of the largest value] A smaller remainder is none: it may be a few roundings of the values.
/// tests/unit/departure_test.cpp
inline constexpr double negligible_measure = 1e-9;
/// [of the slope before a reset] A smaller slope is a stop, not a passage.
/// tests/unit/crossing_decisions_test.cpp
inline constexpr double stopped_slope = 1e-6;
/// [of the slope after a reset] A smaller slope before it, of either sign, is that of bodies in contact: a
/// method at a loose tolerance leaves them 1e-4 of the speeds of others. A guard that came from its
/// firing side has a larger one. tests/unit/crossing_decisions_test.cpp
inline constexpr double struck_slope = 1e-3;
/// [of the speed before a reset] The same for a guard that jumps, whose slope is measured by the time
/// to go back. A block that falls from rest has 1e-7 to 1e-4 of its speed when it has left the jump by
/// the resolution of the time. tests/semantics/guards_jump_test.cpp
inline constexpr double stopped_share = 1e-3;

// --- contacts with surfaces that move: contact.cpp, contact_guards.cpp

/// [rounds] of Aitken's extrapolation: one for an affine map, one to verify that it is affine, and
/// four for maps that are nearly affine. tests/unit/contact_test.cpp
inline constexpr int fixed_point_rounds = 6;
/// [eps of the size of a state] A reset that moves a state by less has reached its fixed point.
/// tests/unit/contact_test.cpp
inline constexpr double fixed_point_roundings = 64.0;
/// [rounds] of Newton's method onto the surface: one for a guard that is linear, one for the rounding
/// of its slope, and one for curvature, of which a look ahead leaves little.
/// tests/semantics/zeno_stays_at_rest_test.cpp (as small)
inline constexpr int landing_rounds = 3;
/// [of a movement] A reset map that moves a state by less, after it has been moved, leaves it there.
/// tests/semantics/zeno_stays_at_rest_test.cpp (as large)
inline constexpr double same_place = 1e-3;
/// [of a movement] Reset maps take a block after its surface if they leave less of what the surface
/// moves: a fixed point on the surface leaves rounding, any other one all of it.
/// tests/semantics/zeno_stays_at_rest_test.cpp (as large)
inline constexpr double follows_to = 0.5;
/// [eps] Relative movement of a state by curvature. It leaves nine digits above the rounding,
/// enough to know the sign. tests/unit/contact_test.cpp
inline constexpr double visible_lift = 1e9 * eps;
/// [of the run] and [eps |t|]: the shortest and the longest look ahead.
/// tests/unit/contact_test.cpp
inline constexpr double brief_of_run = 1e-9;
inline constexpr double brief_roundings = 1024.0;
inline constexpr double look_ahead_of_run = 1e-3;
/// [looks] that find out whether a surface moves. Each is `probe_growth` times as far as the one
/// before: up to 3e4 looks ahead. tests/unit/contact_guards_test.cpp (as small)
/// tests/semantics/zeno_moving_frame_test.cpp
inline constexpr int probes = 4;
inline constexpr double probe_growth = 30.0;
/// [eps of the size of a state] A fixed point that differs from the held state by more moves.
/// tests/unit/contact_test.cpp
inline constexpr double moved_roundings = 1e3;
/// [1] A force on the surface counts as changed if it changes by more than this part.
/// tests/unit/contact_test.cpp
inline constexpr double changed_force = 1e-5;
/// [errors] A held guard that is further beyond zero than this has moved into its surface.
/// tests/unit/contact_decisions_test.cpp
inline constexpr double clearly_beyond = 1e3;
/// [1] The error of a contact grows by this factor if the guard left it by rounding: the next
/// rounding is as large. tests/unit/contact_decisions_test.cpp
inline constexpr double wavered = 2.0;

// --- Zeno points: zeno.hpp, holds.cpp

/// [eps |t|] A gap that shrinks by less may shrink by the rounding of the event times only.
/// tests/unit/zeno_test.cpp
inline constexpr double gap_roundings = 8.0;
/// [1] With the default Zeno tolerance, the last gap of a series is at most this share of the longest
/// one. A ball has lost a millionth of its first height then, in whatever unit of time.
/// tests/unit/zeno_test.cpp
inline constexpr double short_gap = 1e-3;
/// [1] Above this ratio of gaps, the ratio is computed over two gaps: a slow series amplifies the
/// rounding of event times by 1 / (1 - q)^2. tests/unit/zeno_test.cpp
inline constexpr double slow_series = 0.9;
/// [1] How much the ratio of two gaps may differ from the ratio before it, up or down. A series has
/// nearly one ratio; some short gaps after a long one are none. tests/unit/zeno_test.cpp
inline constexpr double same_ratio = 10.0;
/// [1] How much the distance of the ratio q from 1 may change, if the change of one gap went on for all
/// 1 / (1 - q) gaps that are left. Gaps that fall as k^-p with p > 1 have 1 / p; gaps that approach a
/// length have this length by what they are longer. tests/unit/zeno_test.cpp
inline constexpr double supported_change = 2.0;
/// [1] The next firing may follow within this many of the last gaps. tests/unit/holds_test.cpp
inline constexpr double next_gap = 1.2;

// --- chattering: chattering.cpp (tests/unit/chattering_test.cpp)

/// [flips] of a relation in one instant: both sides lead back to its surface.
/// tests/unit/relations_test.cpp
inline constexpr int fluttering_flips = 3;
/// [events] A guard at rest without a Zeno monitor fires as often as the solver can step; a
/// thousand firings are no approach to a limit.
inline constexpr std::int64_t stuck_firings = 1000;
/// [events] A relation that flips back within its instant slides; each flip costs a restart, so
/// two hundred of them in a row already cost more than any smooth stretch.
inline constexpr std::int64_t flutters = 200;
/// [events] So many roots within `root_rounding` of the time: time does not advance.
inline constexpr std::int64_t roots_in_rounding = 1000;
inline constexpr double root_rounding = 1e6 * eps;
/// [events] So many roots within `idle_share` of the run, while no state moves by its tolerance: at
/// this rate the run would have 1e11 events.
inline constexpr std::int64_t idle_roots = 10'000;
inline constexpr double idle_share = 1e-7;
/// [events] So many within `resting_share` of the run, over which the moves of no state add up to its
/// tolerance: at this rate the run would have 1e9 events.
inline constexpr std::int64_t resting_events = 1'000'000;
inline constexpr double resting_share = 1e-3;

// --- derivatives through the stages of a step: stage_accuracy.cpp (tests/laws/stage_tangents_test.cpp)

/// [tolerances] and [of an entry of S] The largest error estimate of an entry of S in a step that the
/// states have chosen, where the states have one of 1. The estimate is that of the lower order. Of four
/// species, by sixteen parameters, half of the steps have 10 to 40, and with 300 the error at the end is at most
/// twice that of steps which obey the tolerance.
inline constexpr double most_stage_error = 300.0;
inline constexpr double most_stage_share = 0.1;
/// [tolerances] What is allowed where the states themselves have no error, as at rest.
inline constexpr double free_stage_error = 0.01;
/// [eps] The rounding of an entry of S that its estimate may have.
inline constexpr double stage_rounding = 1e3;

// --- jumps of the flow without an event: flow_switches.cpp (tests/laws/moved_jumps_test.cpp)

/// [of a step] Where the branches of a flow are looked at. They change one by one, because a jump makes
/// the steps around it short; the points beside the middle are those of the stages of dopri5.
inline constexpr double looks_at_branches[] = {0.05, 0.11, 0.2, 0.3,       0.42, 0.5,
                                               0.58, 0.69, 0.8, 8.0 / 9.0, 0.95, 1.0};
/// More changes in one step are not followed.
inline constexpr std::size_t most_changes = 1000;
/// [of the largest rate so far] A smaller jump of the flow is a rounding, or a kink between two times.
inline constexpr double least_jump = 1e-10;
/// A jump within so many roundings of a time is at that time.
inline constexpr double roundings_beside_jump = 16.0;

// --- jumps of called functions: time_jumps.cpp (tests/laws/moved_jumps_test.cpp)

/// [of the largest rate so far] A smaller fourth difference of the flow is smooth, or a rounding.
inline constexpr double least_bend = 1e-4;
inline constexpr std::size_t most_called_jumps = 20;  ///< in one step
/// [of the size of a value] The shift after which a jump that moves is elsewhere. It is far above the
/// rounding of a time, and far below the distance of two jumps.
inline constexpr double shift_of_jump = 1e-6;

// --- crawling along a jump of a derivative: crawl.cpp (tests/laws/crawl_test.cpp)

/// [steps] of the first window. A jump that is passed costs some forty steps.
inline constexpr std::int64_t crawl_window = 1000;
/// [of the run] A window that took more is no crawl: the run would have less than 4000 steps.
inline constexpr double crawl_share = 0.25;
/// [mean steps of the window] How far the looks go: the error allows a step some ten tolerances
/// across a jump, and the steps that precede it ten times the mean.
inline constexpr double crawl_ahead = 8.0;
/// [steps] that are compared, and those of them in which a derivative must change its sign. A
/// solution that passes a jump now and then is so near to it in one of forty steps. A solution that
/// slides along a jump is so near in nearly all.
inline constexpr int crawl_compared = 32;
inline constexpr int crawl_reversals = 16;
/// [halvings] They take the ends of a step to neighbouring numbers, or, where the jump is at zero,
/// to 1e-60 of the step.
inline constexpr int crawl_halvings = 200;

// --- poles that a step has passed: poles.cpp (tests/laws/poles_test.cpp)

/// [1] and [of a state] Above this tolerance steps may pass a pole. Of eight scenes with 600 places
/// of the pole each, dop853 passed 7 of 4800 at 1e-4, and no method any at 3e-5 and 1e-5.
inline constexpr double loose_tolerance = 1e-5;
/// [of a side of the step] and [eps |t|] How near to the zero of a divisor the derivative is
/// evaluated: so near that a power of the distance above -1 has lost its area, and so far that the
/// rounding of the time is an eighth of the distance.
inline constexpr double near_pole = 1e-9;
inline constexpr double near_pole_roundings = 8.0;
/// [1] The least ratio of two distances that are compared: 1/sqrt(t) loses a factor of four.
inline constexpr double least_ratio = 16.0;
/// [of the area in the rest of the step] A pole of order one keeps its area; 1/sqrt(t) has a quarter
/// at most, and the error of a numerator some tolerances.
inline constexpr double area_at_pole = 0.3;
/// [sides of the step] How far back steps are compared: where a divisor decays into its rounding, the
/// area of the last steps outweighs that of the noise.
inline constexpr double steps_around = 8.0;
/// [tolerances] The least area of a pole: far above the rounding of a derivative that is zero in
/// exact arithmetic.
inline constexpr double least_pole = 1e-6;

// --- journal and calendar

/// [causes] that a chain remembers: four times the default of max_passes.
/// tests/unit/journal_test.cpp
inline constexpr std::size_t remembered_causes = 400;
/// [causes] The last causes of a chain, which a message shows. tests/unit/journal_test.cpp
inline constexpr std::size_t shown_causes = 6;
/// [eps |t|] Times that differ by rounding only are one instant: 3 * 0.1 and 0.3.
/// tests/unit/calendar_test.cpp
inline constexpr double tick_roundings = 4.0;

// --- islands between which event wires lead

/// [slacks of the time] The shortest delay between islands. An instant reaches two slacks ahead, and
/// so does the end of a window. tests/laws/island_wires_test.cpp
inline constexpr double window_slacks = 8.0;
/// The islands that a thread takes at once: some 100 us of work, against 10 us for a thread to begin.
/// tests/laws/island_wires_test.cpp
inline constexpr std::size_t islands_at_once = 32;

}  // namespace saltus::thresholds
