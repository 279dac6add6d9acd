// The tuning numbers of the Radau methods: name, unit, and derivation or source.
#pragma once

namespace saltus::radau::tuning {

// --- the error of a step: allowed_estimate.hpp

/// [tolerances] Error of a fast part that a step may leave. Two steps of this size each stay within
/// `dense_room`, and one tolerance costs 3 % more calls on the stiff shelf.
inline constexpr double fast_error = 2.0;
/// [1] From this part of its length on, a second try of a step shows too little of what its error
/// depends on: the estimate shrinks by a factor of 0.86 at most then, for three stages.
inline constexpr double alike_tries = 0.95;

// --- Newton's iteration: stage_solver.cpp

/// [failures] of the iteration with a new Jacobian, less the steps without one, from which on a
/// leaf's own Jacobian is compared with a difference: it costs a call, and a right one has so many in
/// a row at jumps only. tests/errors/radau_bad_input_test.cpp
inline constexpr int most_doubts = 10;

// --- factorisation: side_by_side.hpp

/// [factorisations of a real matrix] Time of a complex one (dense, 100 to 400 states: 3.1 to 3.5).
inline constexpr double complex_cost = 3.3;
/// [ns] All matrices of a step together, from which on a second thread pays: to start one takes 20 to
/// 120 us, and a thread of less than 2 ms often waits for the core of its parent. Time in two
/// threads, in times of one, on two cores with other work (3, 5, 7 stages): dense, 100 states 1.09,
/// 1.06, 1.06; 200 states 1.05, 0.57, 0.5 to 1.06; 300 states 0.71, 0.58, 0.61; 600 states 0.89, 0.63,
/// 0.67; band of 11, 5000 states (0.3 to 0.7 ms) 1.1; grid of 40 by 40 0.4, 0.6, 0.6. A solution
/// takes 0.1 ms at 400 states, and stays in one thread. tests/unit/radau_side_by_side_test.cpp
inline constexpr double apart_from = 5e6;

}  // namespace saltus::radau::tuning
