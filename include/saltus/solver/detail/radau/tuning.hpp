// The tuning numbers of the Radau methods: name, unit, and derivation or source. The test that is
// named fails if the number is a hundred times as large, or as small.
#pragma once

namespace saltus::radau::tuning {

// --- the error of a step: allowed_estimate.hpp

/// [tolerances] Error of a fast part that a step may leave. Two steps of this size each stay within
/// `dense_room`, and one tolerance costs 3 % more calls on the stiff shelf.
/// tests/unit/radau_test.cpp
inline constexpr double fast_error = 2.0;
/// [1] A first estimate of a step that is so many times as large as the step before says may come from a
/// jump of the derivative. A smaller one than `least_estimate` [tolerances] may be rounding.
/// tests/laws/radau_jumps_test.cpp
inline constexpr double sudden = 1000.0, least_estimate = 1e-3;
/// [1] From this part of its length on, a second try of a step shows too little of what its error
/// depends on: the estimate shrinks by a factor of 0.86 at most then, for three stages.
/// tests/laws/prothero_robinson_test.cpp (as small)
inline constexpr double alike_tries = 0.95;

/// [1] The ratio of the tolerances to the states counts as this part of it: it matters where atol
/// is ten times rtol |x|. tests/unit/radau_decisions_test.cpp
inline constexpr double absolute_part = 0.1;

// --- an oscillation of the errors of the method before: damping.hpp

/// [1] h |lambda| of the steps that damp it, with three stages: each leaves a third. [steps] of
/// this kind. [1] The estimate may be as large as this many times the oscillation, of which a step
/// has to leave no more than this. tests/laws/fast_modes_test.cpp
inline constexpr double damping_reach = 10.0;
inline constexpr int damping_steps = 5;
inline constexpr double damping_room = 2.0, damping_left = 0.25;
/// [of their length] A shorter step, to a stop time, damps too little.
/// tests/laws/fast_modes_test.cpp
inline constexpr double damping_share = 0.9;

// --- length and order of steps: step_control.hpp

/// [1] Part of the length that the estimate allows (Hairer, Wanner II, IV.8, p. 124).
/// tests/unit/radau_test.cpp
inline constexpr double safety = 0.9;
/// [1] The least and the largest factor of the length (the code RADAU5: 1/5 to 8; a tenth after a
/// jump).
/// tests/unit/radau_test.cpp
inline constexpr double shortest = 0.1, longest = 8.0;
/// [tolerances] A smaller error counts as this one, so that its power is finite: every order gives
/// the largest factor there. tests/unit/radau_decisions_test.cpp (as large)
inline constexpr double no_error = 1e-20;
/// [allowed] A smaller error says nothing about the trend (the code RADAU5).
/// tests/unit/radau_test.cpp
inline constexpr double least_error = 1e-2;
/// [1] The least factor of which a retry is shorter.
/// tests/unit/radau_test.cpp
inline constexpr double longest_retry = 0.9;
/// [1] A step longer by less than this saves less than its factorisation costs (the code RADAU5).
/// tests/unit/radau_test.cpp
inline constexpr double worth_it = 1.2;
/// [theta] From here on the order falls, and up to here it rises (Hairer, Wanner, J. Comput. Appl.
/// Math. 111 (1999) 93, section 4).
/// tests/unit/radau_test.cpp
inline constexpr double falls_from = 0.8, rises_to = 0.002;
/// [theta] Up to here it rises below the usual number of stages: see first_stages.
/// tests/unit/radau_test.cpp
inline constexpr double returns_to = 0.02;
/// [1] rtol from which on a run begins with five and with seven stages. tests/unit/radau_test.cpp
inline constexpr double begins_with_five = 1e-6, begins_with_seven = 1e-9;
/// [1] Ratio of the lengths of steps that count as even, and [steps] with one order before it rises
/// (the same source).
/// tests/unit/radau_test.cpp
inline constexpr double least_even = 0.8, most_even = 1.2;
inline constexpr int even_steps = 10;
/// [1] Part of the contraction before that counts in the next step, so that a step of one iteration
/// does not forget it. tests/unit/radau_test.cpp fails at twice the number, and at a hundredth.
inline constexpr double theta_memory = 0.5;

// --- the stepper: solver.cpp, tries.cpp, inside_step.cpp

/// [of the step] The error of the collocation polynomial has the factor s; so nearer to its begin
/// it is a thousandth of its largest. tests/unit/radau_decisions_test.cpp
inline constexpr double near_begin = 1e-3;
/// [steps] The polynomial of the last step predicts no more than this.
/// tests/laws/linear_invariants_test.cpp (as small)
inline constexpr double furthest = 16.0;
/// [errors of the dense output] How far beyond its root a step is cut, and [of the root] the
/// bounds. tests/unit/radau_decisions_test.cpp
inline constexpr double beyond = 10.0, least_beyond = 1e-12, most_beyond = 1e-2;
/// [tolerances] A step that moves by less passes a jump along the derivative, if that [of itself]
/// changes by more than the second number. tests/unit/radau_decisions_test.cpp
inline constexpr double small_move = 0.5, large_turn = 0.1;

// --- Newton's iteration: convergence.hpp, newton.hpp, stage_solver.hpp

/// [tolerances] The error that the iteration may leave: 0.05 moves the estimate by a twentieth of
/// what a fast part may have; and [eps / rtol] what rounding leaves.
/// tests/unit/radau_decisions_test.cpp
inline constexpr double newton_room = 0.05, room_roundings = 10.0;
/// [1] A contraction known from before judges the first correction as this at least, to the power
/// (the code RADAU5; there eps is the least).
/// tests/unit/radau_test.cpp
inline constexpr double least_factor = 0.01, factor_power = 0.8;
/// [theta] From here on corrections do not shrink (the code RADAU5).
/// tests/unit/radau_test.cpp
inline constexpr double no_contraction = 0.99;
/// [1] The factor of a step whose iteration is slow, and [tolerances of the iteration] the largest
/// error that the last iteration would leave (IV.8, p. 121). tests/unit/radau_test.cpp
inline constexpr double slow_safety = 0.8, most_excess = 20.0;
/// [1] The factor of a step whose iteration diverges (the code RADAU5).
/// tests/errors/radau_bad_input_test.cpp
inline constexpr double diverged_retry = 0.5;
/// [of a state] The change that shows the rounding of f, and [eps] how much of it a residual may
/// be. tests/unit/radau_decisions_test.cpp (the change as large)
inline constexpr double seen_change = 1e-8, residual_roundings = 100.0;
/// [theta] and [iterations] up to which a Jacobian is kept for the next step (the code RADAU5).
/// tests/unit/radau_decisions_test.cpp
inline constexpr double keeps_to = 1e-3;
inline constexpr int keeps_iterations = 2;
/// [steps] of a small system after which its Jacobian is renewed: see LinearSystem::refresh_often.
/// tests/errors/radau_bad_input_test.cpp (as small)
inline constexpr int oldest = 20;

/// [failures] of the iteration with a new Jacobian, less the steps without one, from which on a
/// leaf's own Jacobian is compared with a difference: it costs a call, and a right one has so many
/// in a row at jumps only. tests/errors/radau_bad_input_test.cpp (as large)
inline constexpr int most_doubts = 10;

// --- factorisation: side_by_side.hpp

/// [factorisations of a real matrix] Time of a complex one (dense, 100 to 400 states: 3.1 to 3.5).
/// tests/unit/radau_side_by_side_test.cpp
inline constexpr double complex_cost = 3.3;
/// [ns] All matrices of a step together, from which on a second thread pays: to start one takes 20
/// to 120 us, and a thread of less than 2 ms often waits for the core of its parent. Time in two
/// threads, in times of one, on two cores with other work (3, 5, 7 stages): dense, 100 states 1.09,
/// 1.06, 1.06; 200 states 1.05, 0.57, 0.5 to 1.06; 300 states 0.71, 0.58, 0.61; 600 states 0.89,
/// 0.63, 0.67; band of 11, 5000 states (0.3 to 0.7 ms) 1.1; grid of 40 by 40 0.4, 0.6, 0.6. A
/// solution takes 0.1 ms at 400 states, and stays in one thread.
/// tests/unit/radau_side_by_side_test.cpp
inline constexpr double apart_from = 5e6;

}  // namespace saltus::radau::tuning
