// The tuning numbers of the choice between an explicit and a stiff method: name, unit and
// derivation or source. Where a test is named, it fails if the number is a hundred times as large,
// or as small.
#pragma once

namespace saltus::thresholds {

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
/// [sine^2] A vector that turned by less than a thousandth is an eigenvector as far as its order of
/// magnitude goes; the fit of a pair would divide by this. tests/unit/spectral_radius_test.cpp (as
/// large)
inline constexpr double no_turn = 1e-6;

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

}  // namespace saltus::thresholds
