// The tuning numbers of Jacobians, sparsity and linear solvers: name, unit and derivation or
// source. Where a test is named, it fails if the number is a hundred times as large, or as small.
#pragma once

#include "saltus/base/view.hpp"

namespace saltus::thresholds {

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
